using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Hosts;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>The host's verdict on an event, with a world and no session.</summary>
public sealed class EventValidatorTests
{
    private static readonly BodyId Body = BodyId.OfScene(0);

    private readonly VirtualClock clock = new(SimTime.FromSeconds(100));
    private readonly HostOptions options = new();
    private readonly EventJournal journal = new();
    private readonly ClientStamps stamps = new();
    private readonly SharedWorld world;
    private readonly EventValidator validator;

    public EventValidatorTests()
    {
        SharedClock sharedTime = new(clock);
        sharedTime.Adjust(SimDuration.Zero);
        world = new SharedWorld(BuiltInScenes.Billiards(), options, clock, sharedTime, new SessionCounters());
        SimDuration history = options.Window.History;
        Watermark watermark = new(sharedTime, world, options);
        validator = new EventValidator(
            new PlayerPlaces(options, clock.Now), world, sharedTime, watermark, new WorkBudget(world, sharedTime, null), journal, history);
    }

    [Fact]
    public void Validate_BeforeThereIsAWorld_IsInvalid() => Assert.Equal(Verdict.Invalid, Validate(0));

    [Theory]
    [InlineData(0, Verdict.Accepted)]
    [InlineData(-0.001, Verdict.Accepted)]
    [InlineData(-1000, Verdict.Moved)]
    [InlineData(1000, Verdict.TooEarly)]
    public void Validate_ByItsTime(double seconds, Verdict verdict)
    {
        world.Begin(SimTime.FromSeconds(99));
        world.Step(clock.Now);
        Assert.Equal(verdict, Validate(seconds));
    }

    [Fact]
    public void Validate_BeforeTheStart_IsMovedToIt()
    {
        world.Begin(clock.Now);
        Assert.Equal(Verdict.Moved, Validate(-0.001));
    }

    [Fact]
    public void Validate_FasterThanAPlayerMayGive_IsInvalid()
    {
        world.Begin(SimTime.FromSeconds(99));
        world.Step(clock.Now);
        Assert.Equal(Verdict.Invalid, Validate(0, options.MaxGivenSpeed + 1));
        Assert.Equal(Verdict.Accepted, Validate(0, options.MaxGivenSpeed));
    }

    private Verdict Validate(double seconds, double speed = 1)
    {
        SimTime time = clock.Now + SimDuration.FromSeconds(seconds);
        ExternalEvent external = PlayerAction.SetVelocity(Body, new Vector3D(speed, 0, 0)).Stamp(time, 1, 1);
        return validator.Validate(ref external, stamps);
    }
}
