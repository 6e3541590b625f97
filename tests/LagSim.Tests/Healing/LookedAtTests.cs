using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Healing;

/// <summary>
/// An impact of crowded bodies looks at who is near, and all of them together decide whether the contact lasts; if it does not, those that nothing strikes take
/// no part. So news of a body can change an impact in which it takes no part, before or after: what P8 of docs/HEALING.md is about.
/// </summary>
/// <remarks>
/// A mote of a milligram rattles between two balls of a kilogram that close in, all in free fall, so that they are no island. From its eighth impact on it is
/// crowded, and as soon as the play is below a micrometre the ball that it does not strike is near.
/// </remarks>
public sealed class LookedAtTests
{
    private static readonly BodyId Left = First;
    private static readonly BodyId Right = Second;
    private static readonly BodyId Mote = Third;
    private static readonly BodyId Fourth = BodyId.OfScene(3);

    /// <summary>
    /// The balls close at 4 mm/s, which lasts: the first impact with both of them near takes them together. Not so if just then a fourth ball comes near at
    /// 100 mm/s, though it has struck nobody by then. It has been put there, so news that it was gone before takes away the path on which it was near, and must
    /// take back an impact in which it had no part.
    /// </summary>
    [Theory]
    [InlineData(HealingFault.None)]
    [InlineData(HealingFault.LeavesWhoLooked)]
    internal void Late_WhoWasLookedAtHasGone_TheImpactThatLookedIsTakenBack(HealingFault fault)
    {
        const double Placed = 400e-6;
        const double End = 502e-6;
        const double Gap = (0.1 * (501.938e-6 - Placed)) + 0.5e-6;
        ExternalEvent put = ExternalEvent.Teleport(At(Placed), 1, 2, Fourth, V(1.6000005 + Gap), V(-0.1));
        ExternalEvent news = ExternalEvent.Remove(At(Placed / 2), 1, 1, Fourth);
        Scene scene = Closing(0.004, 0.1, 3e-6, 1);
        Simulation inTime = new(scene, KeepAll);
        inTime.Submit(news);
        inTime.Submit(put);
        inTime.AdvanceTo(At(End));
        EventKey lasts = Impacts(inTime, Left)[^1].Key;
        Assert.Equal(lasts, Impacts(inTime, Right)[^1].Key);
        Assert.Equal(lasts, Impacts(inTime, Mote)[^1].Key);
        Assert.Empty(Impacts(inTime, Fourth));

        Simulation late = new(scene, KeepAll) { Fault = fault };
        late.Submit(put);
        late.AdvanceTo(At(End));
        Assert.Contains(Impacts(late, Left), e => e.Key == lasts); // the same two strike
        Assert.DoesNotContain(Impacts(late, Right), e => e.Key == lasts);
        Assert.Empty(Impacts(late, Fourth)); // nor has it struck anybody since
        late.Submit(news);
        Assert.Equal(fault == HealingFault.None, AreSame(inTime, late));
    }

    /// <summary>
    /// The balls close at 50 mm/s, which does not last; it would with a ton near the right one, which moves the mean. The mote's seventeenth impact, on the
    /// left, is the first that looks beyond the right ball, since that has had eight by then. News of a ton that is near the right ball then, and no more when
    /// that is struck next, must take back an impact in which neither of the two had a part.
    /// </summary>
    [Theory]
    [InlineData(HealingFault.None)]
    [InlineData(HealingFault.OverlooksLooks)]
    internal void Late_SomebodyComesNearToWhoWasLookedAt_TheImpactThatLookedIsTakenBack(HealingFault fault)
    {
        const double Comes = 8e-6;
        const double End = 8.6e-6;
        ExternalEvent news = ExternalEvent.Teleport(At(Comes), 1, 1, Fourth, V(1.60000045 - (0.025 * Comes) + 0.5e-6), V(3));
        Scene scene = Closing(0.05, 1, 0.9e-6, 1000);
        Simulation inTime = new(scene, KeepAll);
        inTime.Submit(news);
        inTime.AdvanceTo(At(End));
        EventKey[] rattles = [.. Impacts(inTime, Mote).Select(e => e.Key)];
        Assert.All(rattles.Take(16), rattle => Assert.Single(new[] { Left, Right }, ball => Impacts(inTime, ball).Any(e => e.Key == rattle)));
        EventKey lasts = rattles[16];
        Assert.Contains(Impacts(inTime, Right), e => e.Key == lasts);

        Simulation late = new(scene, KeepAll) { Fault = fault };
        late.AdvanceTo(At(End));
        Assert.Equal(lasts, Impacts(late, Mote)[16].Key);
        Assert.Contains(Impacts(late, Left), e => e.Key == lasts);
        Assert.DoesNotContain(Impacts(late, Right), e => e.Key == lasts);
        late.Submit(news);
        Assert.Equal(fault == HealingFault.None, AreSame(inTime, late));
    }

    private static Scene Closing(double closing, double rattling, double play, double mass) => new SceneBuilder("mote")
        .AddBody("left", Ball(), V(-0.6 - (play / 2)), V(closing / 2))
        .AddBody("right", Ball(), V(0.6 + (play / 2)), V(-closing / 2))
        .AddBody("mote", Ball(0.1, 1e-6), V(0), V(-rattling))
        .AddBody("fourth", Ball(mass: mass), V(10))
        .Build();

    private static bool AreSame(Simulation expected, Simulation actual) => Bodies(expected).All(body =>
        expected.Timeline(body).Select(e => e.Key).SequenceEqual(actual.Timeline(body).Select(e => e.Key))
        && expected.Timeline(body).Zip(actual.Timeline(body)).All(pair => pair.First.State.IsSameBits(pair.Second.State)));
}
