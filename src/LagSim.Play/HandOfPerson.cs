using System;
using LagSim.Events;
using LagSim.Net.Display;
using LagSim.Net.Sessions;
using LagSim.Scenes;

namespace LagSim.Play;

/// <summary>The hand of a person at a pane: it takes one body, moves it, and throws it.</summary>
/// <remarks>The others get keyframes, and only where they could not tell by themselves where the hand is.</remarks>
/// <param name="session">The peer of the pane.</param>
/// <param name="scene">What is drawn there.</param>
/// <param name="wake">Has the peer send what was done.</param>
internal sealed class HandOfPerson(Session session, PlayScene scene, Action wake)
{
    private BodyId held;
    private HandSender? sender;

    /// <summary>What is drawn there.</summary>
    internal PlayScene Scene { get; } = scene;

    /// <summary>The number that it acts by: the peer's when it began. A host that lost the peer can let it in again under another.</summary>
    internal byte Peer { get; } = session.Peer;

    /// <summary>Whether it holds a body.</summary>
    internal bool IsHolding => sender is not null;

    /// <summary>Takes a body.</summary>
    /// <returns>What was done; null if nothing could be.</returns>
    internal ExternalEvent? Take(BodyId body)
    {
        if (IsHolding || Do(PlayerAction.Grab(body)) is not ExternalEvent done)
        {
            return null;
        }

        held = body;
        sender = new HandSender(body);
        return done;
    }

    /// <summary>Moves.</summary>
    /// <param name="display">What the pane draws: the body is drawn in the hand.</param>
    /// <param name="x">Where to, in metres of the view.</param>
    /// <param name="y">Where to, in metres of the view.</param>
    /// <param name="velocityX">How fast, in metres a second of the worlds.</param>
    /// <param name="velocityY">How fast, in metres a second of the worlds.</param>
    /// <returns>What was done; null where the others can tell by themselves where it is.</returns>
    internal ExternalEvent? Move(DisplayOffsets display, double x, double y, double velocityX, double velocityY)
    {
        if (sender is null || !session.World!.RenderSnapshots.Latest().TryRead(held, session.DisplayTime, out BodyState like))
        {
            return null;
        }

        Vector3D place = Scene.FromView(x, y, like.Position);
        Vector3D velocity = Scene.FromView(velocityX, velocityY, Vector3D.Zero);
        display.SetHand(held, session.Peer, place);
        return sender.TrySample(session.SharedTime.Now, place, velocity, out PlayerAction keyframe) ? Do(keyframe) : null;
    }

    /// <summary>Lets go, and throws at a velocity.</summary>
    /// <returns>What was done; null if it held nothing.</returns>
    internal ExternalEvent? Release(DisplayOffsets display, double velocityX, double velocityY)
    {
        if (sender is null)
        {
            return null;
        }

        sender = null;
        display.ClearHand(held);
        return Do(PlayerAction.Release(held, Scene.FromView(velocityX, velocityY, Vector3D.Zero)));
    }

    /// <summary>Gives a body a velocity, in metres a second of the view, as a cue does.</summary>
    /// <returns>What was done; null if it could not be.</returns>
    internal ExternalEvent? Strike(BodyId body, double velocityX, double velocityY) =>
        Do(PlayerAction.SetVelocity(body, Scene.FromView(velocityX, velocityY, Vector3D.Zero)));

    /// <summary>Does an action.</summary>
    /// <returns>What was done; null if the session refused it.</returns>
    internal ExternalEvent? Do(in PlayerAction action)
    {
        try
        {
            ExternalEvent done = session.Do(action);
            wake();
            return done;
        }
        catch (Exception refused) when (refused is SceneException or InvalidOperationException)
        {
            return null; // the session's limits, or too much at once: the hand goes on
        }
    }
}
