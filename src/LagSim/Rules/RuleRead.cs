using LagSim.Scenes;

namespace LagSim.Rules;

/// <summary>What a call of rules read of the world. It is kept to tell later whether the call would read the same.</summary>
internal struct RuleRead
{
    /// <summary>What it is of.</summary>
    internal RuleReadKind Kind;

    /// <summary>The body; after a region, the n-th that was found there.</summary>
    internal BodyId Body;

    /// <summary>The body's state as it was read; absent for one that is not there.</summary>
    internal BodyState State;

    /// <summary>The hold on it.</summary>
    internal Hold Hold;

    /// <summary>Its properties.</summary>
    internal BodySpec Spec;

    /// <summary>Of a sensor, its index in the scene.</summary>
    internal int Sensor;

    /// <summary>Of a sensor, whether the body is inside of it.</summary>
    internal bool IsInside;

    /// <summary>Of a region, its radius in metres.</summary>
    internal double Radius;

    /// <summary>Of a region or a room, its centre.</summary>
    internal Vector3D Centre;

    /// <summary>Of a room, whether <see cref="Body"/> is not in its own way.</summary>
    internal bool LeavesOut;

    /// <summary>Of a room for a body of <see cref="Spec"/>, whether there is any.</summary>
    internal bool HasRoom;

    /// <summary>Of a region, how many of the reads that follow are the bodies found there.</summary>
    internal int Count;
}
