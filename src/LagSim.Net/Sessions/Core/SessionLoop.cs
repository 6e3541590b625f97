using System;
using System.Threading;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>Runs the steps of a session: incoming datagrams, what is due, and the world.</summary>
internal sealed class SessionLoop
{
    /// <summary>The most datagrams handled in one step, so that a flood cannot keep this peer from its own work.</summary>
    private const int MaxDatagramsAStep = 256;

    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private readonly SessionParts parts;
    private readonly ISessionProtocol protocol;
    private readonly DatagramIntake intake;
    private readonly CancellationToken cancellation;

    internal SessionLoop(SessionParts parts, ISessionProtocol protocol)
    {
        this.parts = parts;
        this.protocol = protocol;
        intake = new DatagramIntake(parts.Counters, protocol, parts.Options.IsProtected);
        cancellation = parts.Options.Cancellation;
    }

    /// <summary>See <see cref="Session.Step"/>.</summary>
    internal SimDuration Step()
    {
        try
        {
            return StepOnce();
        }
        catch (SimulationException failure)
        {
            EndWorld(failure);
            return SimDuration.MaxValue;
        }
    }

    /// <summary>Nothing may be read from a failed world, except the render snapshots published before.</summary>
    internal void EndWorld(SimulationException failure)
    {
        bool isFull = failure is TimelinesFullException;
        if (isFull && protocol.TryRenew(
            SessionEnd.TimelinesFull, $"This peer had no more room for what may still change. {failure.Message}"))
        {
            return;
        }

        if (parts.Status.HasEnded)
        {
            return; // a fresh snapshot would be useless, and the end was reported already
        }

        string why = isFull ? $"{protocol.WhenFull} {failure.Message}"
            : $"The world cannot be simulated any further. {failure.Message}";
        protocol.Farewell(why);
        parts.Status.End(isFull ? SessionEnd.TimelinesFull : SessionEnd.Failed, why, failure);
    }

    private SimDuration StepOnce()
    {
        if (!parts.Status.HasEnded)
        {
            cancellation.ThrowIfCancellationRequested();
        }

        int taken = 0;
        while (taken < MaxDatagramsAStep && parts.Port.TryReceive(buffer, out int length, out PeerAddress from))
        {
            taken++;
            intake.Take(buffer.AsSpan(0, length), from);
        }

        SimTime now = parts.Clock.Now;
        if (!parts.Status.HasEnded)
        {
            protocol.Tend(now);
        }

        SimTime due = parts.Status.HasEnded ? SimTime.MaxValue : protocol.NextDue(now);
        if (parts.World.Live is not null && !parts.Status.HasEnded && !parts.Status.IsRejoining)
        {
            due = StepWorld(now, due);
        }

        SayWhatIsWaitedFor(now);
        if (taken == MaxDatagramsAStep)
        {
            return SimDuration.Zero; // there may be more
        }

        return due == SimTime.MaxValue ? SimDuration.MaxValue : due - parts.Clock.Now; // the time of the step itself is not waited again
    }

    private void SayWhatIsWaitedFor(SimTime now)
    {
        if (parts.Status.State is not (SessionState.Running or SessionState.Ended))
        {
            parts.Status.WaitsFor = protocol.WaitsFor(now);
        }
    }

    /// <summary>Advances the world.</summary>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="due">When something else is due.</param>
    /// <returns>When something is due, by the local clock.</returns>
    private SimTime StepWorld(SimTime now, SimTime due)
    {
        SimTime shared = parts.SharedTime.Now;
        SimTime worldDue = parts.World.Step(shared);
        if (parts.World.Live!.IsBehind)
        {
            parts.Commits.ForgetWhileBehind();
        }

        if (worldDue != SimTime.MaxValue)
        {
            // A shared clock that is behind runs up to 5 % fast, so by the local clock the time comes that much sooner.
            SimDuration left = worldDue - shared;
            due = SimTime.Min(due, now + (parts.SharedTime.Remaining > SimDuration.Zero ? left - (left / 20) : left));
        }

        if (parts.World.HasBegunBy(shared))
        {
            parts.Status.BeginRunning();
        }

        due = protocol.TendWorld(now) ? now : due;
        return parts.Status.State == SessionState.Running ? due : SimTime.Min(due, now + (parts.World.Live.Simulation.Start - shared));
    }
}
