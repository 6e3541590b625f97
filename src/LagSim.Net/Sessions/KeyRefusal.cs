using System;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>Reports that a client showed a wrong connect key: a typing error, or somebody who guesses.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class KeyRefusal
{
    internal KeyRefusal(PeerAddress address, int count, long countOfAll, SimDuration pause)
    {
        Address = address;
        Count = count;
        CountOfAll = countOfAll;
        Pause = pause;
        Sentence = FormattableString.Invariant($"A wrong key came from {address}, number {count} from there and {countOfAll} in all")
            + (pause > SimDuration.Zero ? FormattableString.Invariant($"; no key from there is looked at for {pause.ToSeconds():0} s.") : ".");
    }

    /// <summary>The client's address.</summary>
    public PeerAddress Address { get; }

    /// <summary>How many wrong keys have come from its machine, which is forgotten after ten minutes without one.</summary>
    public int Count { get; }

    /// <summary>How many have come to this session from all machines.</summary>
    public long CountOfAll { get; }

    /// <summary>For how long no key from that machine is looked at; zero for the first few.</summary>
    public SimDuration Pause { get; }

    /// <summary>All of it as a sentence, for a log.</summary>
    public string Sentence { get; }

    /// <inheritdoc cref="Sentence"/>
    public override string ToString() => Sentence;
}
