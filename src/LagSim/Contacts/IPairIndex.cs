using System;
using LagSim.Time;

namespace LagSim.Contacts;

/// <summary>
/// Which bodies another body's path could touch, or come as near to as a hop is high: by what they do, did inside the window, or are to do. An
/// index may name too many, never too few, and its order decides nothing.
/// </summary>
internal interface IPairIndex
{
    /// <summary>
    /// The slots of bodies that the body's newest piece of path may touch from a time on, and for how long the answer is whole; from now on the body is
    /// among those that others are told of. May contain the slot itself. Valid until the next call.
    /// </summary>
    Span<int> Candidates(int slot, double radius, SimTime from, out SimTime until);

    /// <summary>The slots of bodies that the body's newest piece of path may touch at that tick. Changes nothing. Valid until the next call.</summary>
    Span<int> CandidatesAt(int slot, double radius, SimTime time);

    /// <summary>A piece of a body's path of which no <see cref="Candidates"/> was asked, and up to when the body is on it.</summary>
    void Add(int slot, double radius, int segment, SimTime from, SimTime until);

    /// <summary>A body is gone for good.</summary>
    void Forget(int slot);

    /// <summary>What lies before that time is asked for no more.</summary>
    void DropBefore(SimTime edge);
}
