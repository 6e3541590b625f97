using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

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

    /// <summary>How far ahead a timer may be set: 2^20 s, 12 days. One that is due only after the latest instant of a world, 84 days after
    /// the origin, is never due.</summary>
    public static readonly SimDuration MaxDelay = SimDuration.FromSeconds(1 << 20);

    private readonly GameRules rules;
    private readonly RuleMemory memory;
    private readonly SimTime start;
    private readonly RunningRuleCall? running;
    private readonly RuleDeeds deeds;
    private readonly RuleReads reads;
    private readonly RuleDraws draws;
    private readonly List<RuleNotice> notices = new();
    private EventKey key;
    private bool isCalled;

    internal RuleWorld(Scene scene, GameRules rules, RuleMemory memory, RuleView view, SimTime start, RunningRuleCall? running)
    {
        this.running = running;
        Scene = scene;
        this.rules = rules;
        this.memory = memory;
        deeds = new RuleDeeds(scene);
        reads = new RuleReads(scene, view);
        draws = new RuleDraws(scene, start);
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
    internal RuleDeeds Deeds => deeds;

    /// <summary>What the last call said that it costs, in units of about a microsecond.</summary>
    internal double Charged { get; private set; }

    /// <summary>What it told.</summary>
    internal List<RuleNotice> Notices => notices;

    /// <summary>What it read.</summary>
    internal List<RuleRead> Reads => reads.All;

    /// <summary>Whether rules have done in this tick what they may: 64 rounds of events, or 16,384 acts. What this call does to bodies then
    /// has no effect, and a timer without delay is due in the next tick.</summary>
    /// <remarks>So a chain of rules that answer what they cause themselves ends. What is not done can be done by a later timer.</remarks>
    public bool IsChainOver
    {
        get
        {
            CheckCalled();
            return deeds.IsOver;
        }
    }

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
            if (!TryRead(body, out _) && !(key.Kind is EventKind.Remove or EventKind.Lost && key.Body == body))
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

    /// <summary>
    /// The properties of a body that is there, or of whose going this call tells (<see cref="GameRules.OnRemoved"/>, <see
    /// cref="GameRules.OnLost"/>), so that another like it can be spawned; the default for any other.
    /// </summary>
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
        return reads.IsInside(body, sensor);
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
        return reads.Within(centre, radius, found);
    }

    /// <summary>Whether there is room for a body that is not there yet: whether a place is inside of no body and no static geometry that it
    /// would collide with, as the world is right after the event of this call.</summary>
    /// <param name="spec">Its properties; radius and filter count.</param>
    /// <param name="position">The place of its centre, in metres.</param>
    /// <remarks>Touching is room. Noted as a read: a late event that changes the answer has the call made again. Cost: the number of bodies
    /// in the world.</remarks>
    /// <exception cref="RuleException">The position is not finite, or the call has read too often.</exception>
    public bool IsRoomFor(BodySpec spec, Vector3D position)
    {
        CheckCalled();
        return reads.HasRoom(spec, position, null);
    }

    /// <summary>The same for a body that is there, with the filter that it has now: whether it could be put at a place. It is not in its own
    /// way; one that is not there has no room.</summary>
    /// <exception cref="RuleException">The position is not finite, or the call has read too often.</exception>
    public bool IsRoomFor(BodyId body, Vector3D position)
    {
        RuleRead there = Read(body);
        return there.State.Motion != MotionLaw.Absent && reads.HasRoom(there.Spec.With(there.State.Filter), position, body);
    }

    /// <summary>A random number of 64 bits: a function of the scene's seed, the event of this call, and how many were drawn in it.</summary>
    /// <remarks>So it is the same on every peer and needs no state. Who chooses when he acts can choose what he draws: let what a player
    /// gains hang on a draw of a later call, such as a timer's, which he cannot time.</remarks>
    public ulong Random()
    {
        CheckCalled();
        return draws.Next();
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
    /// <param name="after">How long from now, at least zero: with zero it is due in the next round of this tick, or in the next tick if
    /// <see cref="IsChainOver"/>. A timer that would be due only after the latest instant of a world, 84 days after the origin, is set, and
    /// never due.</param>
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

        after = after == SimDuration.Zero && !deeds.MayCause() ? SimDuration.OneTick : after;
        memory.Set(new RuleTimer(RuleTimer.DueAfter(Elapsed, after), after == SimDuration.Zero ? key.Round + 1 : 0, timer));
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

    /// <summary>A new body appears if there is room for it (<see cref="IsRoomFor(BodySpec, Vector3D)"/>), also beside those that this call has
    /// spawned; otherwise nothing happens.</summary>
    /// <returns>Whether it appears. It does unless the chain is over (<see cref="IsChainOver"/>), which gives false too.</returns>
    /// <exception cref="SceneException">A value other than the place may not enter the world.</exception>
    /// <exception cref="RuleException">The call has made too many acts or read too often, or the rules have spawned 4,294,967,295
    /// bodies.</exception>
    public bool TrySpawn(
        BodySpec spec, Vector3D position, out BodyId body, Vector3D velocity = default, Vector3D spin = default, PeerSet players = default)
    {
        body = default;
        if (IsChainOver || !IsRoomFor(spec, position) || !deeds.IsApartFromSpawned(spec, position))
        {
            return false;
        }

        body = Spawn(spec, position, velocity, spin, players);
        return true;
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

    /// <summary>
    /// Says that this call is dear: so much work is charged to the player who caused it, besides what every call counts. No rule of the world
    /// depends on it: where there is no <see cref="Hosting.WorkLedger"/>, nothing comes of it.
    /// </summary>
    /// <remarks>
    /// <para>A command is charged to who sent it, what is told of a player to that player, and a contact, a crossing, or what is told of a
    /// body to the account that the body is on. A timer and the start are nobody's. A host sends away who takes more than its
    /// <c>PlayerBudget</c>.</para>
    /// <para>Say what the call takes on the slowest machine that plays, before it is done: what a call has said counts also where it then
    /// fails. A call that is made again for a late event counts again, by half for who was late. Several in one call add up.</para>
    /// </remarks>
    /// <param name="work">How much, in units of about a microsecond on one core; 0 to 1e9.</param>
    /// <exception cref="RuleException">It is not from 0 to 1e9.</exception>
    public void Charge(double work)
    {
        CheckCalled();
        Charged += work is >= 0 and <= 1e9 ? work
            : throw new RuleException($"A call says that it costs {work.ToString(System.Globalization.CultureInfo.InvariantCulture)}; it must be 0 to 1e9 units of about a microsecond.");
    }

    /// <summary>Tells the game outside something, such as that there was a goal: <see cref="Hosting.RuleNotices"/> has it as predicted, and
    /// as confirmed when nothing can change it any more.</summary>
    /// <param name="code">What; the game's own meaning.</param>
    /// <param name="value">More about it.</param>
    /// <param name="key">What it is about, such as a player, where several things of one code are told: a late event that moves one of them
    /// moves the one of that key.</param>
    /// <exception cref="RuleException">The call has told too much, or the code is one of the world's own
    /// (<see cref="RuleNotice.CommandFailed"/>, <see cref="RuleNotice.ChainEnded"/>).</exception>
    public void Tell(int code, long value = 0, long key = 0)
    {
        CheckCalled();
        if (notices.Count == MaxNotices)
        {
            throw new RuleException($"A call told {MaxNotices} things; it may tell no more.");
        }

        if (code <= RuleNotice.ChainEnded)
        {
            throw new RuleException($"Code {code} is told, which stands for what the world tells itself; codes from {RuleNotice.ChainEnded + 1} on are the game's.");
        }

        notices.Add(new RuleNotice(code, value, key));
    }

    /// <summary>A call begins.</summary>
    /// <param name="call">The call.</param>
    internal void Begin(RuleCall call)
    {
        key = call.Key;
        draws.Begin(call);
        deeds.Begin(call);
        reads.Begin(key);
        notices.Clear();
        Charged = 0;
        isCalled = true;
    }

    /// <summary>What the call did and told counts as not done.</summary>
    internal void Forget()
    {
        deeds.Clear();
        notices.Clear();
    }

    /// <summary>It has ended.</summary>
    internal void End() => isCalled = false;

    private static string Name(Type? type) => type is null ? "none" : type.ToString();

    private RuleRead Read(BodyId body)
    {
        CheckCalled();
        return reads.Body(body);
    }

    private void Act(in ExternalEvent what)
    {
        CheckCalled();
        deeds.Add(what);
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
