using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>One drawn session with stalls: the number of players, their links and rates of actions, and the stalls.</summary>
/// <remarks>Determined by its seed.</remarks>
public sealed class StallCase
{
    /// <summary>The range of a stall: 1 to 60 s.</summary>
    private const double MinSeconds = 1;
    private const double MaxSeconds = 60;

    /// <summary>The least time between two stalls of one peer.</summary>
    private const double MinPause = 2;

    /// <summary>The kinds to draw from. A killed host loses its world, so that is the rarest.</summary>
    private static readonly StallKind[] Kinds =
    [
        StallKind.HostFrozen, StallKind.HostFrozen, StallKind.HostKilled, StallKind.ClientFrozen, StallKind.ClientFrozen, StallKind.ClientKilled,
        StallKind.ClientKilled, StallKind.PortChanges,
    ];

    /// <summary>Draws the session of a seed.</summary>
    public StallCase(ulong seed)
    {
        Seed = seed;
        SeededRandom random = new SeededRandom(seed).Fork(0x57A11);
        Clients = 2 + random.NextInt(3);
        Link = random.Pick([.. LinkProfiles.All]);
        EventsPerSecond = random.NextDouble(0.5, 4);
        List<Stall> stalls = [];
        int count = 1 + random.NextInt(2);
        for (int n = 0; n < count; n++)
        {
            StallKind kind = random.Pick(Kinds);
            int player = kind is StallKind.HostFrozen or StallKind.HostKilled ? 0 : 1 + random.NextInt(Clients);
            double seconds = kind == StallKind.PortChanges
                ? random.NextDouble(2, 5) * Stall.ChangeSeconds
                : MinSeconds * Math.Pow(MaxSeconds / MinSeconds, random.NextDouble()); // as many of 1 to 8 s as of 8 to 60 s
            double at = random.NextDouble(3, 30);
            foreach (Stall before in stalls.Where(s => s.Player == player))
            {
                bool isBoth = before.Kind != StallKind.PortChanges && kind != StallKind.PortChanges; // ports may change at any time
                at = isBoth ? Math.Max(at, before.EndSeconds + MinPause) : at;
            }

            stalls.Add(new Stall(kind, player, at, seconds));
        }

        Stalls = [.. stalls.OrderBy(s => s.AtSeconds)];
    }

    /// <summary>The seed.</summary>
    public ulong Seed { get; }

    /// <summary>The number of clients.</summary>
    public int Clients { get; }

    /// <summary>The link of each client.</summary>
    public LinkProfile Link { get; }

    /// <summary>The mean number of events per second of each player.</summary>
    public double EventsPerSecond { get; }

    /// <summary>The stalls, in order of time.</summary>
    public IReadOnlyList<Stall> Stalls { get; }

    /// <summary>The end of the last stall.</summary>
    public double EndSeconds => Stalls.Max(s => s.EndSeconds);

    /// <summary>Returns a short description.</summary>
    public override string ToString() => string.Create(
        CultureInfo.InvariantCulture, $"{Clients} clients, {Link.Name}, {EventsPerSecond:0.0} events/s each; {string.Join("; ", Stalls)}");
}
