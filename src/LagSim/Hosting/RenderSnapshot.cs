using System;
using System.Linq;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>
/// The data that a game's frame reads: the paths of all bodies over a span of time, as the simulation had them at one moment.
/// </summary>
/// <remarks>
/// It does not change while its reader has it, that is, until the reader asks its <see cref="RenderTripleBuffer"/> for the next. For the
/// one reading thread. Reading is a pure function of the render snapshot and the time, takes no lock and allocates nothing.
/// </remarks>
public sealed class RenderSnapshot
{
    private const int GiveBackEvery = 512; // copies: at 60 a second, and with three snapshots that take turns, some twenty seconds

    private RenderTimeline[] timelines = Array.Empty<RenderTimeline>();
    private double[] radii = Array.Empty<double>();
    private ulong[] tags = Array.Empty<ulong>(); // only once some body has one
    private ulong[] identities = Array.Empty<ulong>();
    private int[] slots = Array.Empty<int>();
    private long orderVersion = -1;
    private PeriodicBox box;
    private RenderRules? rules; // only in a scene that has some
    private Scene? scene;
    private int copies;

    internal RenderSnapshot()
    {
    }

    /// <summary>Counts the render snapshots that were published; 0 before the first, which shows nothing.</summary>
    public long Number { get; private set; }

    /// <summary>When the scene began: rules count from there.</summary>
    public SimTime Start { get; private set; }

    /// <summary>The earliest instant shown.</summary>
    public SimTime From { get; private set; } = SimTime.MaxValue;

    /// <summary>The last instant shown; <see cref="SimTime.MaxValue"/> if nothing more was going to happen.</summary>
    public SimTime To { get; private set; } = SimTime.MinValue;

    /// <summary>How many bodies it knows, absent ones included.</summary>
    public int BodyCount { get; private set; }

    /// <summary>The identity of the n-th body in canonical order.</summary>
    public BodyId BodyAt(int n) => n >= 0 && n < BodyCount ? BodyId.FromPacked(identities[n])
        : throw new ArgumentOutOfRangeException(nameof(n), n, $"The render snapshot has {Limits.Count(BodyCount, "body", "bodies")}, counted from 0.");

    /// <summary>Whether the instant is shown.</summary>
    public bool Covers(SimTime time) => time >= From && time <= To;

    /// <summary>Where a body is at an instant that the render snapshot covers.</summary>
    /// <returns>False if the instant is not covered, or the body is unknown or not there; the state is then the default.</returns>
    /// <remarks>
    /// An instant that is not covered is no mistake of a reader: the thread that makes render snapshots may be late.
    /// <see cref="Simulation.TryRead"/> throws there.
    /// </remarks>
    public bool TryRead(BodyId body, SimTime time, out BodyState state)
    {
        int at = Covers(time) ? Array.BinarySearch(identities, 0, BodyCount, body.Packed) : -1;
        state = at < 0 ? default : timelines[slots[at]].At(time, box);
        return state.Motion != MotionLaw.Absent;
    }

    /// <summary>The hold on a body at an instant that the render snapshot covers: which peer holds it, and by which point.</summary>
    /// <returns>False, and the default, if no peer holds it, or the instant is not covered.</returns>
    public bool TryReadHold(BodyId body, SimTime time, out Hold hold)
    {
        int at = Covers(time) ? Array.BinarySearch(identities, 0, BodyCount, body.Packed) : -1;
        hold = default;
        return at >= 0 && timelines[slots[at]].TryReadHold(time, out hold);
    }

    /// <summary>Reads the last hold on a body that ended between two instants: by a release, a removal, another hand, or because no keyframe
    /// came.</summary>
    /// <param name="body">The body.</param>
    /// <param name="after">The earlier instant, itself left out.</param>
    /// <param name="upTo">The later one.</param>
    /// <param name="hold">The hold that ended.</param>
    /// <param name="at">When it ended.</param>
    /// <returns>False if none ended, or an instant is not covered.</returns>
    public bool TryReadHoldEnd(BodyId body, SimTime after, SimTime upTo, out Hold hold, out SimTime at)
    {
        int n = Covers(after) && Covers(upTo) ? Array.BinarySearch(identities, 0, BodyCount, body.Packed) : -1;
        hold = default;
        at = default;
        return n >= 0 && timelines[slots[n]].TryReadHoldEnd(after, upTo, out hold, out at);
    }

    /// <summary>The world's state of the scene's rules, such as a score, at an instant that the render snapshot covers.</summary>
    /// <typeparam name="T">The type that the rules declare.</typeparam>
    /// <returns>False, and the default, if the instant is not covered, or the scene has no rules.</returns>
    /// <remarks>It is what the world predicts: a late event may still change it. Cost: the calls since that instant, and a copy.</remarks>
    /// <exception cref="System.InvalidOperationException">The rules declare another type, or none.</exception>
    public bool TryReadRules<T>(SimTime time, out T state)
        where T : unmanaged
    {
        RuleStateReader.CheckWorld<T>(scene);
        bool isThere = rules is not null && Covers(time);
        state = isThere ? RuleStateReader.Read<T>(scene!, rules!.At(time)) : default;
        return isThere;
    }

    /// <summary>A body's state of the scene's rules at an instant that the render snapshot covers.</summary>
    /// <typeparam name="T">The type that the rules declare for bodies.</typeparam>
    /// <returns>False, and the default, if the body has none, or as above.</returns>
    /// <exception cref="System.InvalidOperationException">The rules declare another type for bodies, or none.</exception>
    public bool TryReadRules<T>(BodyId body, SimTime time, out T state)
        where T : unmanaged
    {
        RuleStateReader.CheckBody<T>(scene);
        state = default;
        return rules is not null && Covers(time) && RuleStateReader.TryRead(scene!, rules.At(time), body, out state);
    }

    /// <summary>The radius of a body, in metres; 0 for one that is unknown or was never there.</summary>
    public double RadiusOf(BodyId body)
    {
        int at = Array.BinarySearch(identities, 0, BodyCount, body.Packed);
        return at < 0 ? 0 : radii[slots[at]];
    }

    /// <summary>The tag of a body, 64 bits of the game's own; 0 for one that is unknown or was never there.</summary>
    public ulong TagOf(BodyId body)
    {
        int at = Array.BinarySearch(identities, 0, BodyCount, body.Packed);
        return at < 0 || slots[at] >= tags.Length ? 0 : tags[slots[at]];
    }

    /// <summary>Reads the largest sudden change of a body's velocity, by a bounce or an impulse, between two instants.</summary>
    /// <param name="body">The body.</param>
    /// <param name="after">The earlier instant, itself left out.</param>
    /// <param name="upTo">The later one.</param>
    /// <param name="speed">
    /// The largest such change in m/s, 0 if there was none; <see cref="double.PositiveInfinity"/> if the body was put elsewhere, came or
    /// went in between.
    /// </param>
    /// <returns>False if an instant is not covered or the body is unknown; the change is then 0.</returns>
    public bool TryReadSuddenChange(BodyId body, SimTime after, SimTime upTo, out double speed)
    {
        int at = Covers(after) && Covers(upTo) ? Array.BinarySearch(identities, 0, BodyCount, body.Packed) : -1;
        speed = at < 0 ? 0 : timelines[slots[at]].SuddenChange(after, upTo, box);
        return at >= 0;
    }

    /// <summary>How many segments of paths there is room for.</summary>
    internal int Room => timelines.Sum(timeline => timeline?.Room ?? 0);

    private void SetTag(int slot, ulong tag)
    {
        if (tag != 0 && slot >= tags.Length)
        {
            Array.Resize(ref tags, timelines.Length);
        }

        if (slot < tags.Length)
        {
            tags[slot] = tag;
        }
    }

    /// <summary>Takes over what changed in the simulation since this render snapshot last showed it.</summary>
    internal void Follow(Simulation simulation, SimTime from, long number)
    {
        copies = (copies + 1) % GiveBackEvery;
        int count = simulation.Engine.Bodies.SlotCount;
        if (count > timelines.Length)
        {
            int size = Math.Max(count, timelines.Length * 2);
            Array.Resize(ref timelines, size);
            Array.Resize(ref radii, size);
            Array.Resize(ref identities, size);
            Array.Resize(ref slots, size);
        }

        if (simulation.Engine.Bodies.Version != orderVersion)
        {
            orderVersion = simulation.Engine.Bodies.Version;
            BodyCount = simulation.BodyCount;
            for (int n = 0; n < BodyCount; n++)
            {
                slots[n] = simulation.Engine.Bodies.SlotAt(n);
                identities[n] = simulation.Engine.Bodies.Id(slots[n]).Packed;
            }
        }

        for (int slot = 0; slot < count; slot++)
        {
            timelines[slot] ??= new RenderTimeline();
            timelines[slot].Follow(simulation.Engine.Timelines, slot, from);
            if ((copies + slot) % GiveBackEvery == 0)
            {
                timelines[slot].GiveBack();
            }

            radii[slot] = simulation.Engine.Bodies.Spec(slot).Radius;
            SetTag(slot, simulation.Engine.Bodies.Spec(slot).Tag);
        }

        if (simulation.Engine.Rules is RuleLog log)
        {
            rules ??= new RenderRules();
            rules.Follow(log, from);
        }

        scene = simulation.Scene;
        box = scene.Box;
        Start = simulation.Start;
        Number = number;
        From = from;
        To = simulation.Horizon;
    }
}
