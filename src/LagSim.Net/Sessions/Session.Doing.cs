using System;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <content>What this peer does to the world, and what it hears that others did.</content>
public abstract partial class Session
{
    /// <summary>
    /// Does something to the shared world, now, or later by what <see cref="SessionOptions.Window"/> has of local lag for it: seen here then, by the others too
    /// or as soon as they hear of it.
    /// </summary>
    /// <returns>The stamped event; of a spawn, <see cref="ExternalEvent.Body"/> is the new body.</returns>
    /// <exception cref="InvalidOperationException">
    /// The session is not running; or of a joiner's events <see cref="JoinerSession.MaxUnjudgedEvents"/> wait for the host's verdict, and nothing happened:
    /// it can be done again once verdicts have come.
    /// </exception>
    /// <exception cref="SceneException">
    /// A value may not enter the world, or this peer may not do that, or it is more than <see cref="SessionOptions.MaxGivenSpeed"/> or
    /// <see cref="SessionOptions.MaxSpawned"/> permits here; nothing happened.
    /// </exception>
    /// <exception cref="SimulationException">The world cannot be simulated with it; the session has ended.</exception>
    public ExternalEvent Do(in PlayerAction action) => DoAt(action, SharedTime.IsSet ? SharedTime.Now + Options.Window.LocalLag(action.Kind) : SimTime.MinValue);

    /// <summary>The same, stamped with another time.</summary>
    private protected ExternalEvent DoAt(in PlayerAction action, SimTime time)
    {
        if (State != SessionState.Ended && SharedTime.IsSet)
        {
            BeginRunning(SharedTime.Now);
        }

        if (State != SessionState.Running || World is null)
        {
            throw new InvalidOperationException(State == SessionState.Ended
                ? $"Nothing can be done any more: the session has ended. {EndReason}"
                : State == SessionState.Rejoining ? $"Nothing can be done until this peer is in again. {RenewedBecause}"
                : $"Nothing can be done while the session is {State}; wait until it is Running.");
        }

        ThrowIfTooMuch();
        ExternalEvent external = action.Stamp(time, Peer, LastSequence + 1);
        EventRights.Throw(external, Scene!);
        if (Limits.WhyNot(external, World.Simulation, external.Time, out string sentence) != Verdict.Accepted)
        {
            throw new SceneException(sentence);
        }

        World.NoteNews(Peer);
        try
        {
            if (World.Submit(external) == SubmitResult.TooOld)
            {
                throw new InvalidOperationException(
                    $"Nothing can be done yet: the shared time is {external.Time.ToShortString()}, and what lies before"
                    + $" {World.Simulation.HistoryEdge.ToShortString()} is committed.");
            }
        }
        catch (SimulationException failure)
        {
            EndWorld(failure);
            throw;
        }

        hasUnshown = true;
        Limits.Note(external);
        LastSequence++;
        Publish(external);
        return external;
    }

    /// <exception cref="InvalidOperationException">Of what this peer did too much is not settled yet.</exception>
    private protected virtual void ThrowIfTooMuch()
    {
    }

    private protected void Tell(in LogEntry entry)
    {
        Recent.Add(entry, entry.Verdict == Verdict.Accepted && !IsWithoutEffect);
        IsWithoutEffect = false;
        Logged?.Invoke(entry);
    }

    /// <summary>Brings another peer's accepted event into the world.</summary>
    private protected void Apply(in ExternalEvent external)
    {
        if (World is null)
        {
            throw new InvalidOperationException("An event cannot be accepted before there is a world.");
        }

        hasUnshown = true;
        SimTime now = SharedTime.Now;
        Counters.AddLateness(now - external.Time);
        World.NoteNews(external.Peer);
        World.Advance(now); // what was shown up to now is simulated, so what changes it counts as changed
        switch (strategy.Apply(World, external, now))
        {
            case SubmitResult.RolledBack when strategy.RewritesPast && external.Time < now:
                Counters.Heals++;
                break;
            case SubmitResult.TooOld:
                Counters.EventsLost++;
                IsWithoutEffect = true;
                break;
        }
    }

    /// <summary>Whether the event may enter this world at all; what others send is not trusted to be checked.</summary>
    private protected bool MayEnter(in ExternalEvent external)
    {
        try
        {
            ExternalEventCheck.Throw(external, Scene!);
            return true;
        }
        catch (SceneException)
        {
            return false;
        }
    }
}
