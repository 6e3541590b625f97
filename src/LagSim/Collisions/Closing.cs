using System;

namespace LagSim.Collisions;

/// <summary>How two touching bodies close on each other, and how precisely that is known.</summary>
/// <param name="speed">How fast they close, in m/s; negative where they part.</param>
/// <param name="pressing">How fast that grows, in m/s².</param>
/// <param name="speedOfBoth">How fast the two move, in m/s, added up.</param>
/// <param name="gap">How far apart they are, in metres; negative where they overlap.</param>
/// <param name="rounding">The error of the gap because places are rounded, in metres.</param>
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
    /// How much deeper, in metres, the two may get without an impact where no island holds them: until they are a thousandth of the
    /// restitution threshold deep. Contacts that close only by rounding have all of that from where they are. Contacts that close by more
    /// have what is left of it; otherwise a light body between two that close would go to and fro for ever.
    /// </summary>
    internal double Room(double restitutionThreshold) => Math.Max(0, (IsRounding ? 0 : Math.Min(0, Gap)) + (1e-3 * restitutionThreshold));
}
