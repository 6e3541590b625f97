using System;
using LagSim.Time;

namespace LagSim.BroadPhase;

/// <summary>
/// Which bodies another body's path could touch: by what they do, did inside the window, or are to do. A broad phase may name too many,
/// never too few, none twice, and its order decides nothing.
/// </summary>
internal interface IBroadPhase
{
    /// <summary>
    /// The slots of bodies that the body's newest segment may touch from a time on, and for how long the answer is complete. From now on
    /// other bodies' answers include this body. The answer may contain the slot itself, and slots of bodies that are forgotten. Valid until
    /// the next call. While some body's path may be known beyond that time, <paramref name="heal"/> is the number of the heal, and later
    /// paths of all bodies count too; otherwise it is 0.
    /// </summary>
    Span<int> Candidates(int slot, double radius, SimTime from, long heal, out SimTime until);

    /// <summary>
    /// The slots of bodies that the body's newest segment, for which <see cref="Candidates"/> was called, may touch at that tick. Changes
    /// no answer. Valid until the next call.
    /// </summary>
    Span<int> CandidatesAt(int slot, double radius, SimTime time, bool isHealing);

    /// <summary>Adds a segment for which <see cref="Candidates"/> was not called, with the time up to which the body is on it.</summary>
    void Add(int slot, double radius, int segment, SimTime from, SimTime until);

    /// <summary>A body is gone for good.</summary>
    void Forget(int slot);

    /// <summary>Nothing before that time will be asked for again.</summary>
    void DropBefore(SimTime edge);
}
