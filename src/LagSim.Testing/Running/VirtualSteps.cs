using System;
using System.Collections.Generic;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Testing.Running;

/// <summary>
/// Steps sessions in virtual time, each when it is due or something has arrived for it, in the order in which they were added.
/// </summary>
/// <remarks>Deterministic. For the network's one thread.</remarks>
internal sealed class VirtualSteps
{
    /// <summary>The time after which anything due counts as never due, so that no sum overflows.</summary>
    private static readonly SimDuration Never = SimDuration.FromSeconds(3600);

    private readonly VirtualNetwork network;
    private readonly List<Session> sessions = [];
    private readonly List<SimTime> due = [];
    private readonly List<bool> frozen = [];
    private readonly List<SimTime> busy = []; // until when its last step takes

    /// <summary>Creates an instance without sessions.</summary>
    public VirtualSteps(VirtualNetwork network)
    {
        ArgumentNullException.ThrowIfNull(network);
        this.network = network;
    }

    /// <summary>The sessions, in the order of their numbers.</summary>
    public IReadOnlyList<Session> Sessions => sessions;

    /// <summary>Called with a session's number before each of its steps.</summary>
    public Action<int>? BeforeStep { get; set; }

    /// <summary>
    /// Called with a session's number after each of its steps, once its world is where it should be, or abandoned for now.
    /// </summary>
    public Action<int>? AfterStep { get; set; }

    /// <summary>Called between the steps of a session whose world is not where it should be yet; what it throws ends the run.</summary>
    public Action? BetweenSteps { get; set; }

    /// <summary>
    /// The virtual time that a step takes if it leaves a world behind. With the default, none, machines are as fast as needed, and a
    /// session is stepped until its world is there; on a slow machine its port is served meanwhile.
    /// </summary>
    public SimDuration BusyStep { get; set; }

    /// <summary>
    /// The work that machines do per second of virtual time, as <see cref="WorkLedger"/> counts it; default 0, for machines as fast as
    /// needed. A step takes as long as its work does, and datagrams that arrive meanwhile wait.
    /// </summary>
    public double WorkPerSecond { get; set; }

    /// <summary>Adds a session, due at once, and the port that it listens to.</summary>
    /// <returns>Its number, counted from 0.</returns>
    public int Add(Session session, IDatagramPort port)
    {
        ArgumentNullException.ThrowIfNull(port);
        int number = sessions.Count;
        sessions.Add(session);
        due.Add(network.Clock.Now);
        frozen.Add(false);
        busy.Add(SimTime.MinValue);
        port.Arrived += () => Wake(number);
        return number;
    }

    /// <summary>
    /// Removes the session added last. Its port must be disposed, since datagrams arriving there would wake the next session with its
    /// number.
    /// </summary>
    public void RemoveLast()
    {
        sessions.RemoveAt(sessions.Count - 1);
        due.RemoveAt(due.Count - 1);
        frozen.RemoveAt(frozen.Count - 1);
        busy.RemoveAt(busy.Count - 1);
    }

    /// <summary>
    /// Freezes a session like a stopped process: it is not stepped until <see cref="Thaw"/>, datagrams to it wait at its port
    /// (<see cref="VirtualNetwork.PortRoom"/>), and its clock goes on. With its port disposed it is like a killed process.
    /// </summary>
    public void Freeze(int number)
    {
        frozen[number] = true;
        due[number] = SimTime.MaxValue;
    }

    /// <summary>Resumes a frozen session; it is due at once.</summary>
    public void Thaw(int number)
    {
        frozen[number] = false;
        due[number] = network.Clock.Now;
    }

    /// <summary>Whether a session is frozen.</summary>
    public bool IsFrozen(int number) => frozen[number];

    /// <summary>Replaces a killed session by another: the same program, started again. The former one's port must be disposed.</summary>
    public void Replace(int number, Session session, IDatagramPort port)
    {
        ArgumentNullException.ThrowIfNull(session);
        ArgumentNullException.ThrowIfNull(port);
        sessions[number] = session;
        port.Arrived += () => Wake(number);
        Thaw(number);
    }

    /// <summary>Steps a session next, because something was done with it; a frozen one stays frozen.</summary>
    public void Wake(int number)
    {
        if (number < due.Count && !frozen[number])
        {
            due[number] = SimTime.Max(network.Clock.Now, busy[number]);
        }
    }

    /// <summary>Advances to the next instant at which anything is due, at most to <paramref name="limit"/>, and processes it.</summary>
    public void Advance(SimTime limit)
    {
        SimTime next = network.NextDelivery is SimTime delivery ? SimTime.Min(limit, delivery) : limit;
        foreach (SimTime time in due)
        {
            next = SimTime.Min(next, time);
        }

        network.DeliverUntil(SimTime.Max(next, network.Clock.Now));
        for (int number = 0; number < sessions.Count; number++)
        {
            if (due[number] <= network.Clock.Now)
            {
                BeforeStep?.Invoke(number);
                (WorkLedger? ledger, double before) = (sessions[number].World?.Work, sessions[number].World?.Work?.Total ?? 0);
                SimDuration wait = sessions[number].Step();
                while (IsBehind(sessions[number]) && BusyStep == SimDuration.Zero && WorkPerSecond == 0)
                {
                    BetweenSteps?.Invoke();
                    wait = sessions[number].Step();
                }

                AfterStep?.Invoke(number);
                wait = IsBehind(sessions[number]) ? BusyStep : wait;
                due[number] = wait > Never ? SimTime.MaxValue : network.Clock.Now + (wait > SimDuration.Zero ? wait : SimDuration.OneTick);
                if (WorkPerSecond > 0 && sessions[number].World?.Work is WorkLedger done)
                {
                    busy[number] = network.Clock.Now + SimDuration.FromSeconds((done.Total - (done == ledger ? before : 0)) / WorkPerSecond);
                    due[number] = SimTime.Max(due[number], busy[number]);
                }
            }
        }
    }

    /// <summary>Whether another step would advance the world; a blocked world waits for an event.</summary>
    private static bool IsBehind(Session session) => session.State is not (SessionState.Ended or SessionState.Rejoining)
        && session.World is LiveWorld world && world.IsBehind && world.BlockedAt == SimTime.MaxValue;

    /// <summary>Lets that much true time pass.</summary>
    public void RunFor(SimDuration span)
    {
        SimTime end = network.Clock.Now + span;
        while (network.Clock.Now < end)
        {
            Advance(end);
        }
    }
}
