using System;
using LagSim.Motion;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>How closely other peers follow a hand, and at what rate of keyframes.</summary>
public sealed class HandSenderOptions
{
    /// <summary>The error in metres that other peers may have without a keyframe, above zero; default 0.01.</summary>
    public double Distance { get; init; } = 0.01;

    /// <summary>The least time between two keyframes, however large the error: 1 ms to <see cref="Longest"/>, default 50 ms.</summary>
    public SimDuration Shortest { get; init; } = SimDuration.FromMilliseconds(50);

    /// <summary>
    /// The longest time without a keyframe, however still the hand is: up to half of <see cref="HandPath.Lasts"/>, after which a hold ends
    /// by itself, so that one keyframe may be late; default 400 ms.
    /// </summary>
    public SimDuration Longest { get; init; } = SimDuration.FromMilliseconds(400);

    internal HandSenderOptions Checked()
    {
        if (!(Distance > 0))
        {
            throw new ArgumentOutOfRangeException(nameof(Distance), Distance, "The distance by which others may be off is above 0 m.");
        }

        SimDuration most = HandPath.Lasts / 2;
        if (Longest < SimDuration.FromMilliseconds(1) || Longest > most)
        {
            throw new ArgumentOutOfRangeException(nameof(Longest), Longest.ToShortString(), $"The longest time without a keyframe lies between 1 ms and"
                + $" {most.ToShortString()}.");
        }

        if (Shortest < SimDuration.FromMilliseconds(1) || Shortest > Longest)
        {
            throw new ArgumentOutOfRangeException(nameof(Shortest), Shortest.ToShortString(), $"The least time between two keyframes lies between 1 ms and the"
                + $" longest, {Longest.ToShortString()}.");
        }

        return new HandSenderOptions { Distance = Distance, Shortest = Shortest, Longest = Longest };
    }
}
