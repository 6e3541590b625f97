using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Scenes;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Hard;

/// <summary>The same events in the same order whichever index names the pairs to ask.</summary>
internal sealed class EventOrderCase : IHardCase
{
    public string Name => "event-order";

    public string Title => "a long run of a crowd: the same events, to the bit, whether all pairs are looked at or an index of the paths names them";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        (int bodies, double seconds) = context.Size((80, 10.0), (200, 3200.0));
        Scene scene = BuiltInScenes.Crowd(bodies);
        yield return Row(bodies, Run(context, scene, seconds, int.MaxValue, 0), Run(context, scene, seconds, 0, 0.5));
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        const int bodies = 80;
        Scene scene = BuiltInScenes.Crowd(bodies);
        yield return Row(bodies, Run(context, scene, 10, int.MaxValue, 0),
            Run(context, Nudged(scene), 10, 0, 0.5)) with
        { Note = "one ball a unit in the last place further on" };
    }

    private static Scene Nudged(Scene scene)
    {
        SceneBuilder builder = new SceneBuilder(scene.Name).WithGravity(scene.Gravity);
        foreach (StaticPlane plane in scene.Planes)
        {
            builder.AddPlane(plane.Name, plane.Normal, plane.Offset, plane.Restitution);
        }

        foreach (SceneBody body in scene.Bodies)
        {
            Vector3D at = body.Position;
            builder.AddBody(body.Name, body.Spec, body.Name == scene.Bodies[0].Name ? new Vector3D(Math.BitIncrement(at.X), at.Y, at.Z) : at, body.Velocity);
        }

        return builder.Build();
    }

    private static (ulong Events, ulong State, long Count) Run(HardContext context, Scene scene, double seconds, int mostPairs, double done)
    {
        Simulation simulation = new(scene, new SimulationOptions(cancellation: context.Cancellation) { MostPairs = mostPairs });
        SimTime end = SimTime.FromSeconds(seconds);
        while (simulation.SimulatedTo < end)
        {
            simulation.AdvanceTo(SimTime.Min(end, simulation.SimulatedTo + SimDuration.FromSeconds(1)));
            context.Report(done + (0.5 * (simulation.SimulatedTo - SimTime.Zero).ToSeconds() / seconds));
        }

        return (simulation.EventHash(end), simulation.StateHash(end), simulation.EventsProcessed);
    }

    private HardRow Row(int bodies, (ulong Events, ulong State, long Count) pairs, (ulong Events, ulong State, long Count) index) => new(
        Name, FormattableString.Invariant($"{bodies} balls, {pairs.Count:N0} events"),
            new[] { pairs.Events != index.Events, pairs.State != index.State }.Count(differs => differs), "hashes_that_differ", 0,
        "a hash of every event's key and outcome and one of all states at the end: a bit is right or wrong", "the run that looks at all pairs");
}
