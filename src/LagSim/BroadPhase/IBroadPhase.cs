using System;
using LagSim.Time;

namespace LagSim.BroadPhase;

/// <summary>
/// Which bodies another body's path could touch: by what they do, did inside the window, or are to do. An
/// index may name too many, never too few, none twice, and its order decides nothing.
/// </summary>
internal interface IBroadPhase
{
    /// <summary>
    /// The slots of bodies that the body's newest piece of path may touch from a time on, and for how long the answer is whole; from now on the body is
    /// among those that others are told of. May contain the slot itself, and slots of bodies that are forgotten. Valid until the next call. While somebody's
    /// path may be known beyond that time, <paramref name="heal"/> numbers the heal, and what all did after it counts too; else it is 0.
    /// </summary>
    Span<int> Candidates(int slot, double radius, SimTime from, long heal, out SimTime until);

    /// <summary>
    /// The slots of bodies that the body's newest piece of path, of which <see cref="Candidates"/> was asked, may touch at that tick. Changes nothing that is
    /// told. Valid until the next call.
    /// </summary>
    Span<int> CandidatesAt(int slot, double radius, SimTime time, bool isHealing);

    /// <summary>A piece of a body's path of which no <see cref="Candidates"/> was asked, and up to when the body is on it.</summary>
    void Add(int slot, double radius, int segment, SimTime from, SimTime until);

    /// <summary>A body is gone for good.</summary>
    void Forget(int slot);

    /// <summary>What lies before that time is asked for no more.</summary>
    void DropBefore(SimTime edge);
}
