using System;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;

namespace LagSim.Testing;

/// <summary>A player of a running <see cref="SessionTest"/>: what it sees, and what it can do.</summary>
/// <remarks>Passed to the code that acts for it, and valid only during that call. For the thread of the run.</remarks>
public sealed class TestPlayer
{
    private readonly Action wake;

    internal TestPlayer(int number, Session session, Action wake)
    {
        Number = number;
        Session = session;
        this.wake = wake;
    }

    /// <summary>The player's number in the test; 0 is the host.</summary>
    public int Number { get; }

    internal bool HasLeft { get; private set; }

    /// <summary>
    /// Its session, for reading. Act by <see cref="Do"/> and <see cref="Leave"/>; otherwise the action waits for the session's next step.
    /// </summary>
    public Session Session { get; }

    /// <summary>The time on its clock: seconds of shared time since the start of the world.</summary>
    public double Seconds => (Session.SharedTime.Now - Session.World!.Simulation.Start).ToSeconds();

    /// <summary>
    /// Reads a body as the player sees it now: the state that a frame drawn at this moment would show, at
    /// <see cref="Session.DisplayTime"/>.
    /// </summary>
    /// <param name="body">The body.</param>
    /// <param name="state">Its state, in metres, metres per second and radians per second.</param>
    /// <returns>False if it is not there, or its render snapshot does not cover this moment.</returns>
    public bool TryRead(BodyId body, out BodyState state) => Session.World!.RenderSnapshots.Latest().TryRead(body, Session.DisplayTime, out state);

    /// <summary>Performs an action now. The player's own world has it at once, the others' when they receive it.</summary>
    /// <param name="action">The action.</param>
    /// <returns>The stamped event; for a spawn its <see cref="ExternalEvent.Body"/> is the new one.</returns>
    /// <exception cref="SessionTestException">The player may not do that, or not now; the message says why.</exception>
    public ExternalEvent Do(in PlayerAction action)
    {
        ExternalEvent external;
        try
        {
            external = Session.Do(action);
        }
        catch (Exception refused) when (refused is SceneException or InvalidOperationException or SimulationException)
        {
            string what = FormattableString.Invariant($"Player {Number} could not do its {action.Kind} at {Seconds:0.###} s");
            throw new SessionTestException($"{what}: {refused.Message}", refused);
        }

        wake();
        return external;
    }

    /// <summary>Leaves the session with a goodbye. The player is not compared with the others from then on.</summary>
    /// <exception cref="SessionTestException">The player is the host, without which there is no session.</exception>
    public void Leave()
    {
        if (Number == 0)
        {
            throw new SessionTestException("Player 0 is the host and cannot leave: without it there is no session to test.");
        }

        HasLeft = true;
        Session.Leave();
        wake();
    }
}
