using System.Collections.Generic;
using LagSim.Net.Sessions;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>One client of a session with stalls, across all its restarts.</summary>
internal sealed class StallClient
{
    private readonly StallHostLog host;
    private readonly LogCoverage coverage;
    private readonly List<(SimTime Start, SimTime Time, ulong Hash)> states = [];

    internal StallClient(int address, StallHostLog host, int overlooked)
    {
        Address = address;
        this.host = host;
        coverage = new LogCoverage(host.AcceptedOf, index => index >= 5 && index < 5 + overlooked);
    }

    /// <summary>The client's index, from 1.</summary>
    internal int Address { get; }

    /// <summary>The player's first number.</summary>
    internal int Number { get; set; }

    /// <summary>The current session.</summary>
    internal ClientSession Session { get; private set; } = null!;

    /// <summary>The pass, kept as a program keeps it in a file.</summary>
    internal PlayerPass Pass { get; private set; }

    /// <summary>The number of current stalls that affect it, the host's among them.</summary>
    internal int Stalls { get; set; }

    /// <summary>The time since which it is not up to date; null while it is.</summary>
    internal SimTime? Since { get; set; }

    /// <summary>The host it must hear from, and the log entries it must have, to be up to date.</summary>
    internal (HostSession? Host, uint Length) Log { get; set; }

    /// <summary>The number of datagrams that it had received by then.</summary>
    internal long Received { get; set; }

    /// <summary>The reasons of its interruptions.</summary>
    internal List<string> Interruptions { get; } = [];

    internal long Copies { get; private set; }

    internal long Regained { get; private set; }

    internal long Compared { get; private set; }

    internal long Differed { get; private set; }

    /// <summary>The number of accepted events that it should have received.</summary>
    internal long Expected { get; private set; }

    /// <summary>The number of those that it did not receive.</summary>
    internal long Lost { get; private set; }

    internal void Follow(ClientSession session)
    {
        Session = session;
        session.PassGiven += pass => Pass = pass;
        coverage.Follow(session);
        session.Renewed += _ => Copies++;
        session.Regained += () => Regained++;
        session.Interrupted += Interruptions.Add;
        session.StateCommitted += state => states.Add((session.World!.Simulation.Start, state.Time, state.StateHash));
    }

    /// <summary>Compares its records with the hosts', at the end.</summary>
    internal void Compare()
    {
        (Expected, Lost) = coverage.Count();
        foreach ((SimTime start, SimTime time, ulong hash) in states)
        {
            if (host.TryGet(start, time, out ulong theirs))
            {
                Compared++;
                Differed += hash == theirs ? 0 : 1;
            }
        }
    }
}
