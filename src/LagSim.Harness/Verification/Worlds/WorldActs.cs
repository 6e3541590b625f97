using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Draws what players do in a world: at any instant, and at the very ticks of impacts, steps and crossings.</summary>
/// <remarks>
/// A scout world goes ahead of the drawing and tells the tick of its next event and whose it is. Often two players act on one awake body
/// within a tenth of a second, as honest players do who do not know of each other yet.
/// </remarks>
internal sealed class WorldActs
{
    private const int Players = 3;
    private const int FewestActs = 5;
    private const int MaxActs = 18;
    private const int MaxSpawns = 4;
    private const int MaxRemovals = 2;

    /// <summary>The part of a run in which players act, so that some of it is left for what follows from it.</summary>
    private const double BusyPart = 0.75;

    /// <summary>How soon, in seconds, a second player acts who does not know of the first one's act yet.</summary>
    private const double Soon = 0.1;

    private readonly WorldScene world;
    private readonly SeededRandom random;
    private readonly Simulation scout;
    private readonly SimTime busy, end;
    private readonly List<ExternalEvent> acts = [];
    private readonly List<(SimTime Time, byte Peer, PlayerAction Action)> planned = []; // what hands will do
    private readonly uint[] sequences = new uint[Players + 1];
    private SimTime now; // what is simulated, whatever was submitted since
    private long budget;
    private int spawns, removals;

    private WorldActs(WorldScene world, SeededRandom random, Simulation scout, long budget)
    {
        (this.world, this.random, this.scout, this.budget) = (world, random, scout, budget);
        now = scout.SimulatedTo;
        end = scout.Start + SimDuration.FromSeconds(world.Seconds);
        busy = scout.Start + SimDuration.FromSeconds(world.Seconds * BusyPart);
    }

    /// <summary>The acts, in order of time.</summary>
    internal IReadOnlyList<ExternalEvent> All => acts;

    /// <summary>How many of them are at the tick of an event, or next to it.</summary>
    internal int AtEvents { get; private set; }

    /// <summary>How often a second player acted on the same awake body within a tenth of a second.</summary>
    internal int Meetings { get; private set; }

    /// <summary>Draws the acts of a world. What ends the scout ends the drawing: the world that has these acts is to be judged.</summary>
    internal static WorldActs Draw(WorldScene world, SeededRandom random, SimulationOptions options, long budget)
    {
        WorldActs drawn = new(world, random, new Simulation(world.Scene, options), budget);
        try
        {
            drawn.Run();
        }
        catch (SimulationException)
        {
            // The world that is judged ends in the same way, and says so.
        }

        return drawn;
    }

    private void Run()
    {
        int count = FewestActs + random.NextInt(MaxActs - FewestActs + 1);
        double gap = 2 * (busy - scout.Start).ToSeconds() / count;
        while (acts.Count < count || planned.Count > 0)
        {
            bool isTogether = acts.Count > 0 && random.IsLucky(20), isSoon = acts.Count > 0 && !isTogether && random.IsLucky(30);
            SimTime time = isTogether ? now
                : isSoon ? SimTime.Max(now, acts[^1].Time + SimDuration.FromSeconds(Soon * random.NextDouble()))
                : now + SimDuration.FromSeconds(gap * random.NextDouble());
            int next = Earliest();
            if (next >= 0 && (planned[next].Time <= time || acts.Count >= count))
            {
                if (planned[next].Time > end || !TryAdvance(planned[next].Time))
                {
                    return;
                }

                Submit(planned[next].Peer, planned[next].Action);
                planned.RemoveAt(next);
                continue;
            }

            if (time > busy || !TryAdvance(time))
            {
                return;
            }

            bool isAtEvent = !isTogether && !isSoon && random.IsLucky(60);
            if (isAtEvent && !TryAdvanceToAnEvent())
            {
                return;
            }

            AtEvents += isAtEvent ? 1 : 0;
            Act(isTogether || isSoon);
        }
    }

    private bool TryAdvance(SimTime time)
    {
        now = SimTime.Max(time, now);
        return scout.TryAdvanceTo(now, ref budget);
    }

    /// <summary>Goes to the tick of the next event, or to the one before or after it.</summary>
    private bool TryAdvanceToAnEvent()
    {
        SimTime last = scout.Horizon; // nothing happens up to here
        return last > busy || TryAdvance(last + (SimDuration.OneTick * random.Pick(0, 1, 1, 1, 1, 2)));
    }

    private int Earliest()
    {
        int earliest = -1;
        for (int i = 0; i < planned.Count; i++)
        {
            earliest = earliest < 0 || planned[i].Time < planned[earliest].Time ? i : earliest;
        }

        return earliest;
    }

    private void Act(bool isNearTheLast)
    {
        ExternalEvent last = isNearTheLast ? acts[^1] : default;
        byte peer = (byte)(1 + random.NextInt(Players));
        BodyId? same = isNearTheLast && last.Kind != EventKind.Command && random.IsLucky(75) && IsAwake(last.Body) ? last.Body : null;
        if (same is not null && random.IsLucky(80))
        {
            peer = (byte)(1 + (last.Peer % Players)); // another player
            Meetings++;
        }

        if (DrawAction(peer, same ?? DrawBody()) is PlayerAction action)
        {
            Submit(peer, action);
        }
    }

    private bool IsAwake(BodyId body) => scout.TryRead(body, scout.SimulatedTo, out BodyState state) && state.Motion != MotionLaw.Resting;

    /// <summary>One to which something happens at this tick, if there is any; else mostly one that is awake.</summary>
    private BodyId? DrawBody()
    {
        BodyId[] there = [.. Enumerable.Range(0, scout.BodyCount).Select(scout.BodyAt)
            .Where(b => scout.TryRead(b, scout.SimulatedTo, out _))];
        BodyId[] struck = [.. there.Where(b => LastEvent(b) == scout.SimulatedTo)];
        BodyId[] awake = [.. there.Where(IsAwake)];
        return struck.Length > 0 && random.IsLucky(70) ? random.Pick(struck)
            : awake.Length > 0 && random.IsLucky(70) ? random.Pick(awake)
            : there.Length > 0 ? random.Pick(there)
            : null;
    }

    private SimTime LastEvent(BodyId body)
    {
        IReadOnlyList<TimelineEntry> entries = scout.Timeline(body, scout.SimulatedTo);
        return entries.Count == 0 ? SimTime.MinValue : entries[^1].Key.Time;
    }

    private PlayerAction? DrawAction(byte peer, BodyId? chosen)
    {
        EventKind kind = random.Pick(
            EventKind.SetVelocity, EventKind.SetVelocity, EventKind.SetVelocity, EventKind.Impulse, EventKind.Impulse, EventKind.Teleport,
            EventKind.Teleport, EventKind.Spawn, EventKind.Remove, EventKind.Grab, EventKind.Grab, EventKind.SetFilter, EventKind.SetFilter,
            EventKind.SetFilter, EventKind.Command);
        bool isPossible = kind switch
        {
            EventKind.Spawn => spawns < MaxSpawns,
            EventKind.Remove => removals < MaxRemovals,
            EventKind.Grab => world.HasHands,
            EventKind.SetFilter => world.HasFilters,
            EventKind.Command => world.Kind == WorldKind.Rules,
            _ => true,
        };
        kind = isPossible ? kind : EventKind.SetVelocity;
        if (chosen is not BodyId body)
        {
            kind = EventKind.Spawn;
            body = default;
        }

        WhenOccupied occupied = random.Pick(WhenOccupied.Overlap, WhenOccupied.Skip, WhenOccupied.Beside);
        Vector3D velocity = world.DrawVelocity(random);
        spawns += kind == EventKind.Spawn ? 1 : 0;
        removals += kind == EventKind.Remove ? 1 : 0;
        return kind switch
        {
            EventKind.Spawn => PlayerAction.Spawn(world.DrawSpec(random), DrawPlace(), velocity, whenOccupied: occupied),
            EventKind.Remove => PlayerAction.Remove(body),
            EventKind.Teleport => PlayerAction.Teleport(body, DrawPlace(), random.IsLucky(50) ? Vector3D.Zero : velocity,
                occupied),
            EventKind.Impulse => PlayerAction.Impulse(body, velocity * (scout.SpecOf(body).Mass * random.NextDouble(0.2, 1))),
            EventKind.Grab => Grab(peer, body),
            EventKind.SetFilter => PlayerAction.SetFilter(body, WorldScenes.DrawFilter(random)),
            EventKind.Command => PlayerAction.Command(new GameCommand(random.NextInt(5), [(byte)random.NextInt(256)])),
            _ => PlayerAction.SetVelocity(body, velocity),
        };
    }

    /// <summary>A place of the scene, or one in another body.</summary>
    private Vector3D DrawPlace() =>
        random.IsLucky(25) && DrawBody() is BodyId other && scout.TryRead(other, scout.SimulatedTo, out BodyState state)
            ? state.Position + WorldDraws.InCube(random, 0.1)
            : world.DrawPlace(random);

    /// <summary>A hand takes the body; what it does afterwards is planned.</summary>
    private PlayerAction Grab(byte peer, BodyId body)
    {
        Vector3D offset = WorldDraws.InCube(random, 0.05);
        SimTime at = scout.SimulatedTo;
        scout.TryRead(body, at, out BodyState state);
        Vector3D place = state.Position + offset;
        for (int left = 1 + random.NextInt(6); left > 0; left--)
        {
            double after = random.Pick(0.01, 0.04, 0.1);
            at += SimDuration.FromSeconds(after);
            Vector3D velocity = WorldDraws.InCube(random, 2);
            place += velocity * after;
            planned.Add((at, peer, PlayerAction.HoldKeyframe(body, place, velocity)));
        }

        if (random.IsLucky(80))
        {
            planned.Add((at + SimDuration.FromMilliseconds(20), peer, PlayerAction.Release(body, world.DrawVelocity(random))));
        }

        return PlayerAction.Grab(body, offset);
    }

    private void Submit(byte peer, PlayerAction action)
    {
        ExternalEvent act = action.Stamp(scout.SimulatedTo, peer, sequences[peer] + 1);
        try
        {
            scout.Submit(act);
        }
        catch (SceneException)
        {
            return; // refused at the door
        }

        sequences[peer]++;
        acts.Add(act);
    }
}
