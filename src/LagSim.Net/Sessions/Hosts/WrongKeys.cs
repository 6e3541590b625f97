using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Slows down who guesses connect keys: each machine after its first few wrong ones, for twice as long each time, and all machines together.
/// </summary>
/// <remarks>
/// A machine that waits is told so whatever its key is, so it learns nothing of it. Who shows the right key with a player's pass or a connect
/// token is no guesser. Memory is bounded: only wrong keys make an entry, and of those all machines together have few a second. For one thread.
/// </remarks>
internal sealed class WrongKeys
{
    private static readonly SimDuration First = SimDuration.FromSeconds(1);
    private static readonly SimDuration Longest = SimDuration.FromSeconds(64);

    /// <summary>How long after its last wrong key a machine is forgotten.</summary>
    private static readonly SimDuration Memory = SimDuration.FromSeconds(600);

    private readonly Dictionary<PeerAddress, Guesses> machines = new();
    private readonly List<PeerAddress> rested = new();
    private readonly RateLimit ofAll;
    private readonly int free;
    private long count;

    /// <param name="limits">How many keys may be wrong.</param>
    /// <param name="now">The time by the local clock.</param>
    internal WrongKeys(JoinLimits limits, SimTime now)
    {
        free = limits.FreeWrongKeys;
        ofAll = new RateLimit(limits.WrongKeysPerSecondOfAll, limits.WrongKeyBurstOfAll, now);
    }

    /// <summary>Raised for each wrong key.</summary>
    internal event Action<KeyRefusal>? Refused;

    /// <summary>How long until a key of a machine is looked at again; zero for now.</summary>
    internal SimDuration Wait(PeerAddress machine, SimTime now) =>
        machines.TryGetValue(machine, out Guesses guesses) && now < guesses.Until ? guesses.Until - now : SimDuration.Zero;

    /// <summary>Whether all machines together have guessed too often for another key to be looked at now.</summary>
    internal bool AreTooMany(SimTime now) => ofAll.Left(now) < 1;

    /// <summary>Takes note of a wrong key; once for a join, however often it comes before it is answered.</summary>
    /// <param name="from">The client's address.</param>
    /// <param name="proof">What it showed of the key, which is another one for each join.</param>
    /// <param name="now">The time by the local clock.</param>
    internal void Add(PeerAddress from, Token128 proof, SimTime now)
    {
        Forget(now);
        PeerAddress machine = from.Machine;
        if (machines.TryGetValue(machine, out Guesses guesses) && guesses.Proof == proof)
        {
            return;
        }

        ofAll.TrySpend(now);
        count++;
        int guessed = guesses.Count + 1;
        SimDuration pause = SimDuration.Zero;
        for (int n = free; n <= guessed && pause < Longest; n++)
        {
            pause = pause == SimDuration.Zero ? First : pause * 2;
        }

        machines[machine] = new Guesses(guessed, proof, now, now + pause);
        Refused?.Invoke(new KeyRefusal(from, guessed, count, pause));
    }

    private void Forget(SimTime now)
    {
        rested.Clear();
        foreach (KeyValuePair<PeerAddress, Guesses> one in machines)
        {
            if (now - one.Value.Last > Memory)
            {
                rested.Add(one.Key);
            }
        }

        rested.ForEach(machine => machines.Remove(machine));
    }

    private readonly record struct Guesses(int Count, Token128 Proof, SimTime Last, SimTime Until);
}
