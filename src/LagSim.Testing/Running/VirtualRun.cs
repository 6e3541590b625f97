using System;
using System.Threading;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Testing.Running;

/// <summary>One run of sessions in virtual time: the clock, the network, and the sessions that are stepped.</summary>
internal sealed class VirtualRun
{
    private const double FramesPerSecond = 60;

    private readonly CancellationToken cancellation;
    private Action? frame;
    private SimTime nextFrame = SimTime.MaxValue; // true time

    /// <summary>Creates a run without sessions.</summary>
    /// <param name="originSeconds">The true time at which the run begins, in seconds. Larger than the lag of any machine's clock.</param>
    /// <param name="seed">The seed of the network's random numbers.</param>
    /// <param name="cancellation">Stops the run.</param>
    internal VirtualRun(double originSeconds, ulong seed, CancellationToken cancellation)
    {
        this.cancellation = cancellation;
        Clock = new VirtualClock(SimTime.FromSeconds(originSeconds));
        Network = new VirtualNetwork(Clock, seed);
        Steps = new VirtualSteps(Network);
    }

    /// <summary>The clock that reads true time.</summary>
    internal VirtualClock Clock { get; }

    internal VirtualNetwork Network { get; }

    internal VirtualSteps Steps { get; }

    /// <summary>The address of the host. Clients have the addresses from 1 on.</summary>
    internal static PeerAddress HostAddress => PeerAddress.Virtual(0);

    /// <summary>Creates a session on a machine with its own port and clock.</summary>
    /// <param name="address">0 for the host.</param>
    /// <param name="link">A client's link to the host; null for the host.</param>
    /// <param name="clockPartsPerMillion">How much faster than true time the machine's clock runs, in parts per million.</param>
    /// <param name="clockOffset">How far the machine's clock is ahead of true time.</param>
    /// <param name="make">Creates the session on that port and clock.</param>
    /// <returns>The session, and its index among the stepped sessions.</returns>
    internal (Session Session, int Number) Open(
        int address,
        LinkProfile? link,
        double clockPartsPerMillion,
        SimDuration clockOffset,
        Func<IDatagramPort, SkewedClock, Session> make)
    {
        if (link is not null)
        {
            Network.Connect(address, 0, link);
        }

        IDatagramPort port = Network.CreatePort(address);
        Session session = make(port, new SkewedClock(Clock, clockPartsPerMillion, clockOffset));
        return (session, Steps.Add(session, port));
    }

    /// <summary>Calls <paramref name="each"/> once per rendered frame, 60 times a second, until <see cref="EndFrames"/>.</summary>
    internal void BeginFrames(Action each)
    {
        frame = each;
        nextFrame = Clock.Now;
    }

    /// <summary>Stops the calls of <see cref="BeginFrames"/>.</summary>
    internal void EndFrames() => nextFrame = SimTime.MaxValue;

    /// <summary>Advances to the next instant at which anything is due, at most to <paramref name="limit"/>, and processes it.</summary>
    /// <exception cref="OperationCanceledException">The run was cancelled.</exception>
    internal void Advance(SimTime limit)
    {
        cancellation.ThrowIfCancellationRequested();
        Steps.Advance(SimTime.Min(limit, nextFrame));
        if (Clock.Now >= nextFrame)
        {
            frame!();
            nextFrame += SimDuration.FromSeconds(1 / FramesPerSecond);
        }
    }

    /// <summary>Advances to a time. Does nothing if the time is past.</summary>
    /// <exception cref="OperationCanceledException">The run was cancelled.</exception>
    internal void AdvanceTo(SimTime time)
    {
        while (Clock.Now < time)
        {
            Advance(time);
        }
    }

    /// <summary>Advances until a condition holds.</summary>
    /// <param name="isMet">The condition.</param>
    /// <param name="isImpossible">Whether the condition can no longer come true.</param>
    /// <param name="timeoutSeconds">The longest wait, in seconds of virtual time.</param>
    /// <returns>Why the wait ended.</returns>
    /// <exception cref="OperationCanceledException">The run was cancelled.</exception>
    internal WaitEnd RunUntil(Func<bool> isMet, Func<bool> isImpossible, double timeoutSeconds)
    {
        SimTime deadline = Clock.Now + SimDuration.FromSeconds(timeoutSeconds);
        while (!isMet())
        {
            if (Clock.Now >= deadline)
            {
                return WaitEnd.TimedOut;
            }

            if (isImpossible())
            {
                return WaitEnd.Impossible;
            }

            Advance(deadline);
        }

        return WaitEnd.Met;
    }
}
