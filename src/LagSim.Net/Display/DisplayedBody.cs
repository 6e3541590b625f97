using LagSim.Scenes;

namespace LagSim.Net.Display;

/// <summary>What <see cref="DisplayOffsets"/> keeps of a body from frame to frame.</summary>
internal struct DisplayedBody
{
    internal BodyId Body;
    internal bool IsThere;
    internal BodyState State;
    internal double Radius;
    internal Vector3D Offset;
    internal double Size; // of the offset
    internal double TimeConstant;
    internal double Jump;
    internal double Decay;
    internal double Dropped;
    internal bool IsHeld; // by this player's own hand
    internal byte Holder;
    internal Vector3D HoldOffset;

    /// <summary>It is there, and drawn so far from where it is.</summary>
    internal void Take(in BodyState state, double radius, in Vector3D offset)
    {
        IsThere = true;
        State = state;
        Radius = radius;
        Offset = offset;
        Size = offset.Length;
    }

    internal readonly DrawnBody ToDrawn() => new(State, Offset, Jump, Decay, Dropped);

    internal void ShrinkTo(double size)
    {
        Offset = size > 0 ? Offset * (size / Size) : Vector3D.Zero;
        Size = size;
    }

    internal void Drop()
    {
        Dropped += Size;
        ShrinkTo(0);
    }
}
