using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>How long answers on a link take, and when something is sent again without one.</summary>
internal readonly struct ResendTimes
{
    /// <param name="answer">See <see cref="Answer"/>.</param>
    /// <param name="ackDelay">See <see cref="AckDelay"/>.</param>
    /// <param name="interval">See <see cref="Interval"/>.</param>
    internal ResendTimes(SimDuration answer, SimDuration ackDelay, SimDuration interval)
    {
        Answer = answer;
        AckDelay = ackDelay;
        Interval = interval;
    }

    /// <summary>What an answer takes at most, as far as is known.</summary>
    internal SimDuration Answer { get; }

    /// <summary>How much longer it may take for what later entries make up for.</summary>
    internal SimDuration AckDelay { get; }

    /// <summary>After how long something goes out in any case.</summary>
    internal SimDuration Interval { get; }
}
