using System;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <content>One step: what has come in, what is due, and the world.</content>
public abstract partial class Session
{
    /// <summary>As many datagrams are taken in at a time at most: whoever floods this peer does not keep it from its own work.</summary>
    private const int MaxDatagramsAStep = 256;

    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private readonly UpdateDatagram received = new();

    /// <summary>
    /// Does what is due: takes in datagrams, sends, brings the world ahead, by a bounded number of events; see <see cref="LiveWorld.IsBehind"/>.
    /// </summary>
    /// <returns>How long until something is due again, unless a datagram or an action comes first.</returns>
    /// <remarks>A world that cannot be simulated any further ends the session, with the reason; whatever others send, it does not throw.</remarks>
    /// <exception cref="OperationCanceledException"><see cref="SessionOptions.Cancellation"/> asked for an end, and the session has not ended; <see cref="Leave"/> ends it.</exception>
    public SimDuration Step()
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

    private SimDuration StepOnce()
    {
        if (State != SessionState.Ended)
        {
            cancellation.ThrowIfCancellationRequested();
        }

        int taken = 0;
        while (taken < MaxDatagramsAStep && Port.TryReceive(buffer, out int length, out PeerAddress from))
        {
            taken++;
            Counters.DatagramsReceived++;
            Receive(buffer.AsSpan(0, length), from);
        }

        SimTime now = Clock.Now;
        if (State != SessionState.Ended)
        {
            Tend(now);
        }

        SimTime due = State == SessionState.Ended ? SimTime.MaxValue : NextDue(now);
        if (World is not null && State is not (SessionState.Ended or SessionState.Rejoining))
        {
            SimTime shared = SharedTime.Now;
            SimTime worldDue = World.Step(shared);
            if (World.BlockedAt < SimTime.MaxValue && shared - World.BlockedAt > Options.Window.History)
            {
                throw new SimulationException(World.BlockedBecause); // the cause is older than the history by now, and cannot be removed
            }

            if (hasUnshown && !World.IsBehind)
            {
                Counters.LastShown = SharedTime.Now;
                hasUnshown = false;
            }

            if (World.IsBehind)
            {
                ForgetWhileBehind();
            }

            if (worldDue != SimTime.MaxValue)
            {
                // A shared clock that is behind is bent to run up to 5 % fast: by the own clock the time then comes that much sooner.
                SimDuration left = worldDue - shared;
                due = SimTime.Min(due, now + (SharedTime.Remaining > SimDuration.Zero ? left - (left / 20) : left));
            }

            BeginRunning(shared);
            due = TendWorld(now) ? now : due;
            if (State != SessionState.Running)
            {
                due = SimTime.Min(due, now + (World.Simulation.Start - shared));
            }
        }

        if (taken == MaxDatagramsAStep)
        {
            return SimDuration.Zero; // there may be more
        }

        return due == SimTime.MaxValue ? SimDuration.MaxValue : due - Clock.Now; // what the step itself took is not waited again
    }

    /// <summary>Whatever is to be done when the world has got as far as it could; true if it changed the world, which then goes on at once.</summary>
    private protected virtual bool TendWorld(SimTime now) => false;

    private void BeginRunning(SimTime shared)
    {
        if (World is not null && State is not (SessionState.Ended or SessionState.Rejoining) && shared >= World.Simulation.Start)
        {
            State = SessionState.Running;
        }
    }

    private void Receive(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        WireRefusal refusal;
        if (!WireFormat.TryReadType(datagram, out DatagramType type, out refusal))
        {
            Counters.DatagramsMalformed++;
            if (refusal == WireRefusal.VersionDiffers)
            {
                OnOtherVersion(datagram, from);
            }
        }
        else if (type != DatagramType.Update)
        {
            OnDatagram(type, datagram, from);
        }
        else if (received.TryDecode(datagram, out refusal))
        {
            OnUpdate(received, from);
        }
        else
        {
            Counters.DatagramsMalformed++;
        }
    }
}
