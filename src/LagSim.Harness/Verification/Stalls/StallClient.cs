using System.Collections.Generic;
using LagSim.Net.Sessions;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>One client of a session with stalls, through all the sessions that it has when it is killed and started again.</summary>
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

    /// <summary>Which client it is, from 1.</summary>
    internal int Address { get; }

    /// <summary>The player's number that it got first.</summary>
    internal int Number { get; set; }

    /// <summary>The session that it has now.</summary>
    internal ClientSession Session { get; private set; } = null!;

    /// <summary>What it kept, as a program does in a file.</summary>
    internal PlayerPass Pass { get; private set; }

    /// <summary>How many stalls befall it at the moment, the host's among them.</summary>
    internal int Stalls { get; set; }

    /// <summary>Since when it is waited for until it is up to date; null while it is not.</summary>
    internal SimTime? Since { get; set; }

    /// <summary>Which host it is to hear from, and how much of its log it is to have.</summary>
    internal (HostSession? Host, uint Length) Log { get; set; }

    /// <summary>How many datagrams had come to it by then.</summary>
    internal long Received { get; set; }

    /// <summary>Why it was interrupted, each time.</summary>
    internal List<string> Interruptions { get; } = [];

    internal long Copies { get; private set; }

    internal long Regained { get; private set; }

    internal long Compared { get; private set; }

    internal long Differed { get; private set; }

    /// <summary>How many accepted events it was to hear of.</summary>
    internal long Expected { get; private set; }

    /// <summary>Of how many of those it did not.</summary>
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

    /// <summary>At the end: holds what it had against what the hosts had.</summary>
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
