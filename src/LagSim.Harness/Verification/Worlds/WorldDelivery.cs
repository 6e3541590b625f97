using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Brings the acts of a world late, shuffled, doubled, retracted and submitted again, while it advances in pieces.</summary>
/// <remarks>What is drawn for an act depends on that act alone, so that leaving out others changes nothing of it.</remarks>
internal sealed class WorldDelivery
{
    private const byte Stranger = 9; // who does what is retracted for good

    private readonly Simulation world;
    private readonly SeededRandom random;
    private readonly WorldBudget budget;

    private WorldDelivery(Simulation world, SeededRandom random, WorldBudget budget) =>
        (this.world, this.random, this.budget) = (world, random, budget);

    /// <summary>What was answered otherwise than it should, as a sentence; null if nothing was.</summary>
    internal string? Wrong { get; private set; }

    /// <summary>Brings acts to a world and advances it to an end.</summary>
    /// <param name="world">The world, which has none of the acts.</param>
    /// <param name="acts">The acts.</param>
    /// <param name="end">Up to when it goes.</param>
    /// <param name="random">The stream to draw from.</param>
    /// <param name="budget">What it may take.</param>
    internal static WorldDelivery Bring(Simulation world, IReadOnlyList<ExternalEvent> acts, SimTime end, SeededRandom random,
        WorldBudget budget)
    {
        WorldDelivery delivery = new(world, random, budget);
        delivery.Run(acts, end);
        return delivery;
    }

    private enum What
    {
        First,
        Again,
        Retract,
        AfterRetract,
    }

    private void Run(IReadOnlyList<ExternalEvent> acts, SimTime end)
    {
        List<(SimTime At, What What, ExternalEvent Act)> plan = [.. acts.SelectMany(Plan)];
        foreach (ExternalEvent act in acts.Where(a => a.Kind is EventKind.SetVelocity or EventKind.Impulse))
        {
            SeededRandom from = StreamOf(act, 1);
            if (from.IsLucky(15))
            {
                // What never was: on the same body, and not there any more in the end.
                ExternalEvent stranger = PlayerAction.SetVelocity(act.Body, WorldDraws.InCube(from, 3)).Stamp(act.Time, Stranger,
                    act.Sequence + (1000u * act.Peer));
                SimTime at = act.Time + Seconds(from, 0.5);
                plan.Add((at, What.First, stranger));
                plan.Add((at + Seconds(from, 0.5), What.Retract, stranger));
            }
        }

        foreach ((SimTime at, What what, ExternalEvent act) in plan.OrderBy(p => p.At).ThenBy(p => p.What))
        {
            SeededRandom from = StreamOf(act, 2 + (ulong)what);
            if (from.IsLucky(30) || at <= world.SimulatedTo)
            {
                // With the one before, before the world goes on.
            }
            else if (from.IsLucky(50))
            {
                budget.AdvancePartly(world, SimTime.Min(at, end), 1 + from.NextInt(40));
            }
            else
            {
                budget.Advance(world, SimTime.Min(at, end));
            }

            Do(what, act);
        }

        budget.Advance(world, end);
    }

    private IEnumerable<(SimTime At, What What, ExternalEvent Act)> Plan(ExternalEvent act)
    {
        SeededRandom from = StreamOf(act, 0);
        SimTime at = from.IsLucky(15) ? world.SimulatedTo : act.Time + Seconds(from, from.Pick(0.05, 0.3, 1));
        yield return (at, What.First, act);
        if (from.IsLucky(25))
        {
            yield return (at + Seconds(from, 0.3), What.Again, act);
        }
        else if (from.IsLucky(25))
        {
            SimTime retracted = at + Seconds(from, 0.3);
            yield return (retracted, What.Retract, act);
            yield return (retracted + Seconds(from, 0.3), What.AfterRetract, act);
        }
    }

    private void Do(What what, in ExternalEvent act)
    {
        if (what == What.Retract)
        {
            bool wasThere = world.Retract(act);
            Wrong ??= wasThere ? null : $"Retracting {act} found nothing.";
            return;
        }

        SubmitResult result = world.Submit(act);
        bool isRight = what == What.Again ? result == SubmitResult.Duplicate : result is SubmitResult.Queued or SubmitResult.RolledBack;
        Wrong ??= isRight ? null : $"Submitting {act} gave {result}.";
    }

    private SeededRandom StreamOf(in ExternalEvent act, ulong purpose) =>
        random.Fork(((ulong)act.Peer << 40) | ((ulong)act.Sequence << 8) | purpose);

    private static SimDuration Seconds(SeededRandom from, double most) => SimDuration.FromSeconds(from.NextDouble() * most);
}
