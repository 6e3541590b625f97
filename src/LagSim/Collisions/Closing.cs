using System;

namespace LagSim.Collisions;

/// <summary>How two that touch close on each other, and how far that can be told.</summary>
/// <param name="speed">How fast they close, in m/s; negative where they part.</param>
/// <param name="pressing">How fast that grows, in m/s².</param>
/// <param name="speedOfBoth">How fast the two move, in m/s, added up.</param>
/// <param name="gap">How far apart they are, in metres; negative where they overlap.</param>
/// <param name="rounding">What the gap may be off by because places are rounded, in metres.</param>
internal readonly struct Closing(double speed, double pressing, double speedOfBoth, double gap, double rounding)
{
    /// <summary>
    /// The part of two speeds by which a solver may leave their difference off: a double's 2^-52, times four million, for unlike masses
    /// multiply it by their ratio.
    /// </summary>
    private const double SolverRounding = 1e-9;

    internal double Speed { get; } = speed;

    internal double Pressing { get; } = pressing;

    internal double Gap { get; } = gap;

    internal double Rounding { get; } = rounding;

    /// <summary>Whether it is so slow that it may be what a solver's rounding has left.</summary>
    internal bool IsRounding { get; } = speed <= SolverRounding * speedOfBoth;

    /// <summary>
    /// How much deeper, in metres, the two may get unseen where no island holds them: until they are a thousandth of the resolution deep. What
    /// rounding makes close has all of that from where it is; what closes by more has what is left of it, else a light body between two that
    /// close goes to and fro for ever.
    /// </summary>
    internal double Room(double resolution) => Math.Max(0, (IsRounding ? 0 : Math.Min(0, Gap)) + (1e-3 * resolution));
}
