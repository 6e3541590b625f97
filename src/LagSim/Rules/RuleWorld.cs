using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>The world as a call of rules sees it: their state, what they may read and draw, and what they may do.</summary>
/// <remarks>
/// <para>It shows the world right after the event of the call. What rules do happens at the same tick, in the next round of events: first
/// spawns, then teleports, set velocities, impulses, removals and changes of filters, those of one kind in the order in which they were asked for. A later call
/// at that tick sees them.</para>
/// <para>Valid during the call, on its thread. Everything that is read is noted, so that the call is made again exactly if a late event
/// changes it. No allocation once the lists have grown.</para>
/// </remarks>
public sealed class RuleWorld
{
    /// <summary>How many acts a call may make: 64.</summary>
    public const int MaxActs = 64;

    /// <summary>How many notices a call may give: 16.</summary>
    public const int MaxNotices = 16;

    /// <summary>How many timers may be set at a time: 256.</summary>
    public const int MaxTimers = StateLayout.MaxTimers;

    /// <summary>How many bodies may have a state at a time: 4,096.</summary>
    public const int MaxBodyStates = StateLayout.MaxBodies;

    /// <summary>How often a call may read a body or a region: 4,096.</summary>
    public const int MaxReads = 4096;

    /// <summary>How far ahead a timer may be set: 2^20 s, 12 days.</summary>
    public static readonly SimDuration MaxDelay = SimDuration.FromSeconds(1 << 20);

    private readonly GameRules rules;
    private readonly RuleMemory memory;
    private readonly RuleView view;
    private readonly SimTime start;
    private readonly RunningRuleCall? running;
    private readonly List<RuleAct> acts = new();
    private readonly List<RuleNotice> notices = new();
    private readonly List<RuleRead> reads = new();
    private EventKey key;
    private uint firstAct;
    private ImpactContact contact; // of an impact, which of its contacts the call is for
    private ulong draws;
    private bool isCalled;

    internal RuleWorld(Scene scene, GameRules rules, RuleMemory memory, RuleView view, SimTime start, RunningRuleCall? running)
    {
        this.running = running;
        Scene = scene;
        this.rules = rules;
        this.memory = memory;
        this.view = view;
        this.start = start;
    }

    /// <summary>The scene.</summary>
    public Scene Scene { get; }

    /// <summary>When this is, in shared simulation time.</summary>
    public SimTime Time
    {
        get
        {
            running?.Touch();
            return key.Time;
        }
    }

    /// <summary>How long ago the scene began.</summary>
    public SimDuration Elapsed => Time - start;

    /// <summary>What the last call did to bodies.</summary>
    internal List<RuleAct> Acts => acts;

    /// <summary>What it told.</summary>
    internal List<RuleNotice> Notices => notices;

    /// <summary>What it read.</summary>
    internal List<RuleRead> Reads => reads;

    /// <summary>Whether it caused something at its own tick.</summary>
    internal bool Chains { get; private set; }

    /// <summary>The world's state, to read and to write. The reference is valid during the call.</summary>
    /// <typeparam name="T">The type that the rules declared by <see cref="GameRules.WithWorldState"/>.</typeparam>
    /// <exception cref="RuleException">They declared another, or none.</exception>
    public ref T State<T>()
        where T : unmanaged
    {
        CheckCalled();
        if (rules.WorldType != typeof(T))
        {
            throw new RuleException($"The world's state is asked for as {typeof(T)}; the rules declared {Name(rules.WorldType)}.");
        }

        return ref memory.World<T>();
    }

    /// <summary>The state of a body that is there, or that this call hears to have been removed, to read and to write; all zero at first.
    /// The reference is valid during the call.</summary>
    /// <typeparam name="T">The type that the rules declared by <see cref="GameRules.WithBodyState"/>.</typeparam>
    /// <exception cref="RuleException">They declared another or none, the body is not there, or too many bodies have a state.</exception>
    public ref T State<T>(BodyId body)
        where T : unmanaged
    {
        CheckCalled();
        if (rules.BodyType != typeof(T))
        {
            throw new RuleException($"A body's state is asked for as {typeof(T)}; the rules declared {Name(rules.BodyType)}.");
        }

        if (!memory.Has(body))
        {
            if (!TryRead(body, out _) && !(key.Kind == EventKind.Remove && key.Body == body))
            {
                throw new RuleException($"{Scene.Describe(body)} is not there and so has no state.");
            }

            if (memory.BodyCount == MaxBodyStates)
            {
                throw new RuleException($"{MaxBodyStates} bodies have a state; no more may have one.");
            }
        }

        return ref memory.Of<T>(body);
    }

    /// <summary>Where a body is and how it moves.</summary>
    /// <returns>False, and a state that is <see cref="MotionLaw.Absent"/>, if it is not there.</returns>
    /// <exception cref="RuleException">The call has read too often.</exception>
    public bool TryRead(BodyId body, out BodyState state)
    {
        RuleRead read = Read(body);
        state = read.State;
        return state.Motion != MotionLaw.Absent;
    }

    /// <summary>Who holds a body, and by which point; false if no peer does.</summary>
    /// <exception cref="RuleException">The call has read too often.</exception>
    public bool TryReadHold(BodyId body, out Hold hold)
    {
        RuleRead read = Read(body);
        hold = read.Hold;
        return read.State.Motion == MotionLaw.Held;
    }

    /// <summary>The properties of a body that is there; the default for any other.</summary>
    /// <exception cref="RuleException">The call has read too often.</exception>
    public BodySpec SpecOf(BodyId body) => Read(body).Spec;

    /// <summary>Whether a body is inside of a sensor, after all crossings up to this call.</summary>
    /// <param name="body">The body.</param>
    /// <param name="sensor">The sensor's index in <see cref="Scene.Sensors"/>, as <see cref="Scene.SensorNamed"/> gives it.</param>
    /// <remarks>A body that is spawned or put inside of a sensor enters it in a crossing of its own, right after that, and one that is
    /// removed leaves it in one. Cost: the crossings
    /// of that body that are known after this call.</remarks>
    /// <exception cref="RuleException">The scene has no such sensor, or the call has read too often.</exception>
    public bool IsInside(BodyId body, int sensor)
    {
        CheckCalled();
        if (sensor < 0 || sensor >= Scene.SensorArray.Length)
        {
            string there = Limits.Count(Scene.SensorArray.Length, "sensor", "sensors");
            throw new RuleException($"Sensor {sensor} is asked for; the scene has {there}, numbered from 0.");
        }

        RuleRead read = view.ReadSensor(body, sensor, key);
        reads.Add(read);
        CheckReads();
        return read.IsInside;
    }

    /// <summary>The bodies whose centres lie within a sphere, by identity. In a periodic box the nearest image of each counts.</summary>
    /// <param name="centre">Its centre, in metres.</param>
    /// <param name="radius">Its radius in metres, at least zero.</param>
    /// <param name="found">Gets as many of them as there is room for.</param>
    /// <returns>How many there are, also those for which there was no room.</returns>
    /// <remarks>Cost: the number of bodies in the world.</remarks>
    /// <exception cref="RuleException">A value is not finite or negative, or the call has read too often.</exception>
    public int Within(Vector3D centre, double radius, Span<BodyId> found)
    {
        CheckCalled();
        if (!centre.IsFinite || !(radius >= 0) || double.IsInfinity(radius))
        {
            throw new RuleException($"A sphere of radius {radius} m at {centre} m is asked for; both must be finite, and the radius at least zero.");
        }

        int region = reads.Count;
        view.ReadRegion(centre, radius, key, reads);
        CheckReads();
        int count = reads[region].Count;
        for (int n = 0; n < count && n < found.Length; n++)
        {
            found[n] = reads[region + 1 + n].Body;
        }

        return count;
    }

    /// <summary>A random number of 64 bits: a function of the scene's seed, the event of this call, and how many were drawn in it.</summary>
    /// <remarks>So it is the same on every peer and needs no state. Who chooses when he acts can choose what he draws: let what a player
    /// gains hang on a draw of a later call, such as a timer's, which he cannot time.</remarks>
    public ulong Random()
    {
        CheckCalled();
        StableHash hash = default;
        hash.Add(Scene.Seed);
        hash.Add(key.Time - start);
        hash.Add(((ulong)key.Round << 8) | (byte)key.Kind);
        hash.Add(key.Body.Packed);
        hash.Add(key.Other.Packed);
        hash.Add(key.Origin);
        if (key.Kind == EventKind.Impact)
        {
            hash.Add(contact.First.Packed);
            hash.Add(contact.Second.Packed);
            hash.Add((long)contact.Surface);
        }

        hash.Add(draws++);
        return hash.Value;
    }

    /// <summary>A random whole number from 0 on and below a limit, each as likely to one part in 2^32.</summary>
    /// <exception cref="RuleException">The limit is not above zero.</exception>
    public int Random(int below)
    {
        if (below <= 0)
        {
            throw new RuleException($"A random number below {below} is asked for; the limit must be above zero.");
        }

        return (int)(((Random() >> 32) * (ulong)below) >> 32);
    }

    /// <summary>A random number from 0 on and below 1, a multiple of 2^-53.</summary>
    public double RandomFraction() => (Random() >> 11) * (1.0 / (1UL << 53));

    /// <summary>Sets a timer, in place of any of that number: <see cref="GameRules.OnTimer"/> is called then.</summary>
    /// <param name="timer">Its number, at least zero; the game's own meaning.</param>
    /// <param name="after">How long from now, at least zero: with zero it is due in the next round of this tick.</param>
    /// <exception cref="RuleException">A value is out of its range, or too many timers are set.</exception>
    public void SetTimer(int timer, SimDuration after)
    {
        CheckCalled();
        if (timer < 0 || after < SimDuration.Zero || after > MaxDelay)
        {
            throw new RuleException($"Timer {timer} is set to {after.ToShortString()} from now; its number must be at least 0, and the time 0 s to"
                + $" {MaxDelay.ToShortString()}.");
        }

        memory.Cancel(timer);
        if (memory.TimerCount == MaxTimers)
        {
            throw new RuleException($"{MaxTimers} timers are set; no more may be.");
        }

        Chains |= after == SimDuration.Zero;
        memory.Set(new RuleTimer((Elapsed + after).Ticks, after == SimDuration.Zero ? key.Round + 1 : 0, timer));
    }

    /// <summary>Cancels a timer; false if none of that number is set.</summary>
    public bool CancelTimer(int timer)
    {
        CheckCalled();
        return memory.Cancel(timer);
    }

    /// <summary>A new body appears; see <see cref="PlayerAction.Spawn"/>.</summary>
    /// <returns>Its identity.</returns>
    /// <exception cref="SceneException">A value may not enter the world.</exception>
    /// <exception cref="RuleException">The call has made too many acts, or the rules have spawned 4,294,967,295 bodies.</exception>
    public BodyId Spawn(
        BodySpec spec, Vector3D position, Vector3D velocity = default, Vector3D spin = default, PeerSet players = default,
        WhenOccupied whenOccupied = WhenOccupied.Overlap)
    {
        CheckCalled();
        if (memory.Spawned == uint.MaxValue)
        {
            throw new RuleException($"The rules have spawned {uint.MaxValue} bodies; no more may be.");
        }

        uint number = (uint)++memory.Spawned;
        BodyId body = new(SceneRules.Peer, number, 0);
        Act(ExternalEvent.Spawn(key.Time, SceneRules.Peer, number, spec, position, velocity, spin, players, whenOccupied));
        return body;
    }

    /// <summary>A body disappears; see <see cref="PlayerAction.Remove"/>.</summary>
    /// <exception cref="SceneException">There can be no such body.</exception>
    /// <exception cref="RuleException">The call has made too many acts.</exception>
    public void Remove(BodyId body) => Act(ExternalEvent.Remove(key.Time, SceneRules.Peer, 1, body));

    /// <summary>A body is put somewhere, with a velocity. One that is held stays in the hand.</summary>
    /// <exception cref="SceneException">A value may not enter the world.</exception>
    /// <exception cref="RuleException">The call has made too many acts.</exception>
    public void Teleport(BodyId body, Vector3D position, Vector3D velocity = default, WhenOccupied whenOccupied = WhenOccupied.Overlap) =>
        Act(ExternalEvent.Teleport(key.Time, SceneRules.Peer, 1, body, position, velocity, whenOccupied));

    /// <summary>A body's velocity becomes this, in m/s. One that is held moves with the hand.</summary>
    /// <exception cref="SceneException">A value may not enter the world.</exception>
    /// <exception cref="RuleException">The call has made too many acts.</exception>
    public void SetVelocity(BodyId body, Vector3D velocity) => Act(ExternalEvent.SetVelocity(key.Time, SceneRules.Peer, 1, body, velocity));

    /// <summary>A body's momentum changes, in newton seconds; see <see cref="PlayerAction.Impulse"/>.</summary>
    /// <exception cref="SceneException">A value may not enter the world.</exception>
    /// <exception cref="RuleException">The call has made too many acts.</exception>
    public void Impulse(BodyId body, Vector3D impulse) => Act(ExternalEvent.Impulse(key.Time, SceneRules.Peer, 1, body, impulse));

    /// <summary>A body collides by this filter from now on; see <see cref="PlayerAction.SetFilter"/>.</summary>
    /// <exception cref="SceneException">There can be no such body.</exception>
    /// <exception cref="RuleException">The call has made too many acts.</exception>
    public void SetFilter(BodyId body, CollisionFilter filter) => Act(ExternalEvent.SetFilter(key.Time, SceneRules.Peer, 1, body, filter));

    /// <summary>Tells the game outside something, such as that there was a goal: <see cref="Hosting.RuleNotices"/> has it as predicted, and
    /// as confirmed when nothing can change it any more.</summary>
    /// <param name="code">What; the game's own meaning.</param>
    /// <param name="value">More about it.</param>
    /// <param name="key">What it is about, such as a player, where several things of one code are told: a late event that moves one of them
    /// moves the one of that key.</param>
    /// <exception cref="RuleException">The call has told too much.</exception>
    public void Tell(int code, long value = 0, long key = 0)
    {
        CheckCalled();
        if (notices.Count == MaxNotices)
        {
            throw new RuleException($"A call told {MaxNotices} things; it may tell no more.");
        }

        notices.Add(new RuleNotice(code, value, key));
    }

    /// <summary>A call begins.</summary>
    /// <param name="call">The call.</param>
    /// <param name="first">The number of its first act among those of its tick and round.</param>
    internal void Begin(RuleCall call, uint first)
    {
        key = call.Key;
        firstAct = first;
        contact = call.Trigger.Contact;
        draws = 0;
        acts.Clear();
        notices.Clear();
        reads.Clear();
        Chains = false;
        isCalled = true;
    }

    /// <summary>It has ended.</summary>
    internal void End() => isCalled = false;

    private static string Name(Type? type) => type is null ? "none" : type.ToString();

    private RuleRead Read(BodyId body)
    {
        CheckCalled();
        RuleRead read = view.ReadBody(body, key);
        reads.Add(read);
        CheckReads();
        return read;
    }

    private void Act(in ExternalEvent what)
    {
        CheckCalled();
        if (acts.Count == MaxActs)
        {
            throw new RuleException($"A call did {MaxActs} things to bodies; it may do no more.");
        }

        ExternalEventCheck.ThrowIfUnfit(what, Scene);
        uint number = checked(firstAct + (uint)acts.Count + 1);
        acts.Add(new RuleAct(new EventKey(key.Time, checked(key.Round + 1), what.Kind, what.Body, what.Body, SceneRules.Peer, number), what));
        Chains = true;
    }

    private void CheckReads()
    {
        if (reads.Count > MaxReads)
        {
            throw new RuleException($"A call read {MaxReads} things of the world; it may read no more.");
        }
    }

    private void CheckCalled()
    {
        if (!isCalled)
        {
            throw new InvalidOperationException("The world of rules is used outside a call of theirs; it is valid during the call only.");
        }

        running?.Touch();
    }
}
