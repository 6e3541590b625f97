using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Drop;

/// <summary>The options of a drop test. The defaults are the thesis's.</summary>
public sealed record DropOptions
{
    /// <summary>The length of the same-start case, in which both balls come to rest, by default at 12.53 s.</summary>
    public static readonly SimDuration SameStartLength = SimDuration.FromSeconds(13);

    /// <summary>The length of the teleport case, in which the lifted ball comes to rest, by default after 15.5 s.</summary>
    public static readonly SimDuration TeleportLength = SimDuration.FromSeconds(17);

    /// <summary>The time of the lift in a run of the teleport case only, after its start. The ball rests until then.</summary>
    public static readonly SimDuration TeleportAlone = SimDuration.FromSeconds(1);

    /// <summary>The cases to run, in order.</summary>
    public IReadOnlyList<DropCase> Cases { get; init; } = [DropCase.SameStart, DropCase.Teleport];

    /// <summary>The strategy of the peers for late events.</summary>
    public string Strategy { get; init; } = LateEventStrategies.Default;

    /// <summary>How far behind shared time <c>interpolation</c> shows the world.</summary>
    public SimDuration DisplayDelay { get; init; } = Interpolation.DefaultDelay;

    /// <summary>The motion law of the ball.</summary>
    public MotionLaw Motion { get; init; } = MotionLaw.RungeKutta4;

    /// <summary>Steps per second of an integrating law; 1 to 10,000. All segments of a run are kept.</summary>
    public double RateHertz { get; init; } = 200;

    /// <summary>The link of each client to the host.</summary>
    public LinkProfile Link { get; init; } = LinkProfiles.PureDelay(25);

    /// <summary>The one-way delay of <see cref="Link"/>, if it adds only that; else null.</summary>
    public double? DelayMilliseconds { get; init; } = 25;

    /// <summary>The number of peers, the host included; 2 to 9.</summary>
    public int Peers { get; init; } = 2;

    /// <summary>Whether it runs in virtual time.</summary>
    public bool IsVirtual { get; init; }

    /// <summary>The carrier of datagrams in real time.</summary>
    public Carrier Carrier { get; init; } = Carrier.Udp;

    /// <summary>The height from which the ball's centre falls at first, in metres.</summary>
    public double HeightMetres { get; init; } = 10;

    /// <summary>The height to which it is lifted, in metres.</summary>
    public double SecondHeightMetres { get; init; } = 15;

    /// <summary>The ball's restitution, 0 to 1.</summary>
    public double Restitution { get; init; } = 0.8;

    /// <summary>The seed of links and clocks.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>
    /// Cancels a run in virtual time, in mid-step if need be, with an <see cref="OperationCanceledException"/>; default none. In real time
    /// the progress callback may end it with an exception.
    /// </summary>
    public CancellationToken Cancellation { get; init; }

    /// <summary>Whether heights and restitution are the thesis's, so that its figures compare.</summary>
    public bool IsThesisSetting => HeightMetres == 10 && SecondHeightMetres == 15 && Restitution == 0.8;

    /// <summary>The length of the run, from the start of the scene.</summary>
    public SimDuration Length =>
        Cases.Count == 2 ? SameStartLength + TeleportLength
        : Cases[0] == DropCase.SameStart ? SameStartLength
        : TeleportAlone + TeleportLength;

    /// <summary>The time of the lift, after the start of the scene; null if there is none.</summary>
    public SimDuration? Lift =>
        Cases.Count == 2 ? SameStartLength : Cases[0] == DropCase.Teleport ? TeleportAlone : null;

    /// <summary>The first and last instant of a case, after the start of the scene.</summary>
    public (SimDuration First, SimDuration Last) Window(DropCase which) =>
        Cases.Count == 1 ? (SimDuration.Zero, Length)
        : which == DropCase.SameStart ? (SimDuration.Zero, SameStartLength)
        : (SameStartLength, Length);

    /// <summary>These options for the lift alone, from rest, in virtual time, once for each strategy: what compares them.</summary>
    public IReadOnlyList<DropOptions> ForEveryStrategy() =>
        [.. LateEventStrategies.Names.Select(name => this with { Cases = [DropCase.Teleport], Strategy = name, IsVirtual = true })];

    /// <summary>The scene: a ball above a floor, or at rest on it if only the teleport case is run.</summary>
    /// <exception cref="SceneException">A height or the restitution is out of range.</exception>
    public Scene BuildScene()
    {
        const double radius = 0.5;
        double height = Cases.Count == 1 && Cases[0] == DropCase.Teleport ? radius : HeightMetres;
        return SceneFiles.BuiltInScenes.Drop(height, Restitution, Motion, RateHertz);
    }
}
