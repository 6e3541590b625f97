using System;
using System.Threading;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Testing.Running;

/// <summary>One run of sessions in virtual time: its clock and its network, who is stepped, and how time passes.</summary>
internal sealed class VirtualRun
{
    private const double FramesPerSecond = 60;

    private readonly CancellationToken cancellation;
    private Action? frame;
    private SimTime nextFrame = SimTime.MaxValue; // true time

    /// <summary>A run without sessions.</summary>
    /// <param name="originSeconds">What true time begins with: more than any machine's clock is behind.</param>
    /// <param name="seed">What the network's luck comes from.</param>
    /// <param name="cancellation">Stops it.</param>
    internal VirtualRun(double originSeconds, ulong seed, CancellationToken cancellation)
    {
        this.cancellation = cancellation;
        Clock = new VirtualClock(SimTime.FromSeconds(originSeconds));
        Network = new VirtualNetwork(Clock, seed);
        Steps = new VirtualSteps(Network);
    }

    /// <summary>True time.</summary>
    internal VirtualClock Clock { get; }

    internal VirtualNetwork Network { get; }

    internal VirtualSteps Steps { get; }

    /// <summary>The address of the host; clients have those from 1 on.</summary>
    internal static PeerAddress HostAddress => PeerAddress.Virtual(0);

    /// <summary>Opens a session on a machine of its own.</summary>
    /// <param name="address">0 for the host.</param>
    /// <param name="link">A client's link to the host; null for the host.</param>
    /// <param name="clockPartsPerMillion">How much too fast the machine's clock runs.</param>
    /// <param name="clockOffset">How far that is ahead.</param>
    /// <param name="make">Makes the session.</param>
    /// <returns>The session, and its number among those that are stepped.</returns>
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

    /// <summary>From now on has that called for each frame that somebody at a screen sees, until <see cref="EndFrames"/>.</summary>
    internal void BeginFrames(Action each)
    {
        frame = each;
        nextFrame = Clock.Now;
    }

    /// <summary>Nobody looks any more.</summary>
    internal void EndFrames() => nextFrame = SimTime.MaxValue;

    /// <summary>Goes to the next moment at which anything is due, at most to <paramref name="limit"/>, and lets it happen.</summary>
    /// <exception cref="OperationCanceledException">It was asked to stop.</exception>
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

    /// <summary>Lets time pass until then; not at all if that is past.</summary>
    /// <exception cref="OperationCanceledException">It was asked to stop.</exception>
    internal void AdvanceTo(SimTime time)
    {
        while (Clock.Now < time)
        {
            Advance(time);
        }
    }

    /// <summary>Lets time pass until something is so.</summary>
    /// <param name="isSo">Whether it is.</param>
    /// <param name="isInVain">Whether it cannot come about any more.</param>
    /// <param name="timeoutSeconds">How long at most.</param>
    /// <returns>How it ended.</returns>
    /// <exception cref="OperationCanceledException">It was asked to stop.</exception>
    internal WaitEnd RunUntil(Func<bool> isSo, Func<bool> isInVain, double timeoutSeconds)
    {
        SimTime deadline = Clock.Now + SimDuration.FromSeconds(timeoutSeconds);
        while (!isSo())
        {
            if (Clock.Now >= deadline)
            {
                return WaitEnd.TimeIsUp;
            }

            if (isInVain())
            {
                return WaitEnd.InVain;
            }

            Advance(deadline);
        }

        return WaitEnd.IsSo;
    }
}
