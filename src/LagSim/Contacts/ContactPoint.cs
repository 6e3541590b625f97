using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>One touching pair of an impact, as the solver sees it. Bodies are numbered within the impact.</summary>
internal struct ContactPoint
{
    /// <summary>A partner that never moves.</summary>
    internal const int Static = -1;

    internal ContactPoint(int first, int second, int surface, ContactTime time)
    {
        First = first;
        Second = second;
        Surface = surface;
        Time = time;
        Normal = default;
        Target = 0;
        Impulse = 0;
        IsStruck = true;
        IsFromBefore = false;
        Lasts = false;
    }

    /// <summary>The body whose identity is the lesser of the two, or the only one.</summary>
    internal int First;

    /// <summary>The other body, or <see cref="Static"/>.</summary>
    internal int Second;

    /// <summary>Which static surface: planes by index, static spheres after them; -1 between two bodies.</summary>
    internal int Surface;

    /// <summary>When it is struck; meaningless where it is not.</summary>
    internal ContactTime Time;

    /// <summary>Whether the two strike each other in this impact, or only last on each other while something strikes them.</summary>
    internal bool IsStruck;

    /// <summary>Whether the two struck each other earlier in the instant, and are in this impact because it is a collapse.</summary>
    internal bool IsFromBefore;

    /// <summary>Whether it is the last rebound of the two, after which they are in persistent contact.</summary>
    internal bool Lasts;

    /// <summary>From the second body, or the surface, to the first body.</summary>
    internal Vector3D Normal;

    /// <summary>The relative normal speed after the impact where the contact pushes at all, in m/s, at least zero.</summary>
    internal double Target;

    /// <summary>The impulse along the normal, in N s; the solver sets it.</summary>
    internal double Impulse;
}
