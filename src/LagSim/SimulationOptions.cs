using LagSim.Time;

namespace LagSim;

/// <summary>How a <see cref="Simulation"/> is run; what it simulates is the scene's.</summary>
/// <remarks>Immutable.</remarks>
public sealed class SimulationOptions
{
    /// <summary>The history where nothing else is said: 1 s.</summary>
    public static readonly SimDuration DefaultHistory = SimDuration.FromSeconds(1);

    /// <summary>Options, each with its default.</summary>
    /// <param name="start">The instant at which the scene begins; default the origin. It has no influence on the motion, to the bit.</param>
    /// <param name="history">
    /// How far behind the simulated time timelines are kept, and so how late an event may come; above zero, default 1 s.
    /// <see cref="SimDuration.MaxValue"/> keeps everything.
    /// </param>
    /// <exception cref="System.ArgumentOutOfRangeException">The history is not above zero, or the start more than 72 days from the origin.</exception>
    public SimulationOptions(SimTime start = default, SimDuration? history = null)
    {
        if (history is SimDuration given && given <= SimDuration.Zero)
        {
            throw new System.ArgumentOutOfRangeException(nameof(history), given, "The history must be longer than zero.");
        }

        if (start.Ticks is < -(3L << 61) or > 3L << 61)
        {
            throw new System.ArgumentOutOfRangeException(nameof(start), start, "The start must lie within 72 days (3 x 2^21 s) of the origin.");
        }

        Start = start;
        History = history ?? DefaultHistory;
    }

    /// <summary>The instant at which the scene begins.</summary>
    public SimTime Start { get; }

    /// <summary>How far behind the simulated time timelines are kept.</summary>
    public SimDuration History { get; }
}
