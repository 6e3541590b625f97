using System;
using LagSim;
using LagSim.Hosting;
using LagSim.Net.Display;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace AirHockey;

/// <summary>Draws what this player holds exactly where the hand is, while all else moves smoothly; and measures what that is worth.</summary>
public sealed class OwnMallet
{
    private readonly Session session;
    private readonly BodyId mallet;
    private double drawnOff; // in metres
    private double worldOff;
    private long frames;

    public OwnMallet(Session session, BodyId mallet)
    {
        (this.session, this.mallet) = (session, mallet);
        Drawn = new DisplayOffsets(session.Scene!);
    }

    /// <summary>Where bodies are drawn.</summary>
    public DisplayOffsets Drawn { get; }

    /// <summary>Says how far the mallet was from the hand, at worst.</summary>
    public override string ToString() => FormattableString.Invariant(
        $"own mallet: {frames} frames in the hand, drawn off by {1000 * drawnOff:0.000} mm at most; in the world off by {1000 * worldOff:0} mm");

    /// <summary>A frame: the hand is here.</summary>
    public void Update(RenderSnapshot snapshot, SimTime now, Vector3D hand)
    {
        Drawn.SetHand(mallet, session.Peer, hand);
        if (Drawn.Update(snapshot, now) && Drawn.TryRead(mallet, out DrawnBody seen) && seen.IsInHand)
        {
            frames++;
            drawnOff = Math.Max(drawnOff, (seen.Position - hand).Length);
            worldOff = Math.Max(worldOff, (seen.State.Position - hand).Length);
        }
    }
}
