using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Time;

namespace LagSim.Net.Carriers;

/// <summary>Gives a limited number of places to connections, so that those of one machine, or of a few, keep nobody else out.</summary>
/// <remarks>
/// <para>A machine has at most half of the places, or one; where it has them all, its next connection takes the place of one of its own.
/// Where all places are taken, the next takes one from the machine with the most, and never one from a machine that has fewer than its own.
/// So whoever opens many connections gives way to who opens few, and nothing has to time out first.</para>
/// <para>Only what is not held is counted for that, and what is safe yields only if its machine still has as many as the newcomer's
/// afterwards (<see cref="ConnectionPlace"/>): what a connection is worth says who uses the place, and nothing is known of a newcomer but its
/// machine.</para>
/// <para>For any thread.</para>
/// </remarks>
/// <param name="most">How many places there are, from 1 on.</param>
/// <param name="clock">By which they are safe and held.</param>
internal sealed class ConnectionLimiter(int most, IClock clock)
{
    private readonly object changing = new();
    private readonly List<ConnectionPlace> places = [];

    /// <summary>The present, by which places are safe and held.</summary>
    internal SimTime Now => clock.Now;

    /// <summary>How many places are taken.</summary>
    internal int Taken
    {
        get
        {
            lock (changing)
            {
                return places.Count;
            }
        }
    }

    /// <summary>Whether a connection of a machine would have a place now.</summary>
    internal bool HasRoom(PeerAddress machine)
    {
        lock (changing)
        {
            return TryFind(machine.Machine, out _);
        }
    }

    /// <summary>Gives a connection a place, if need be that of another, which is ended.</summary>
    /// <param name="machine">Any address of its machine.</param>
    /// <param name="safeFor">How long it does not give way to those of machines that have as many; see <see cref="ConnectionPlace"/>.</param>
    /// <param name="end">Ends the connection, at once: called, at most once, where it gives way.</param>
    /// <returns>The place; null if there is none.</returns>
    internal ConnectionPlace? TryEnter(PeerAddress machine, SimDuration safeFor, Action end)
    {
        ConnectionPlace place = new(this, machine.Machine, end);
        place.KeepSafe(safeFor);
        ConnectionPlace? given;
        lock (changing)
        {
            if (!TryFind(place.Machine, out given))
            {
                return null;
            }

            if (given is not null)
            {
                places.Remove(given);
            }

            places.Add(place);
        }

        given?.End();
        return place;
    }

    /// <summary>Gives a place back. It may have been given to another before.</summary>
    internal void Leave(ConnectionPlace place)
    {
        lock (changing)
        {
            places.Remove(place);
        }
    }

    /// <summary>Finds room for one more of a machine.</summary>
    /// <param name="machine">The machine.</param>
    /// <param name="given">The place that it gets; null if one is free.</param>
    private bool TryFind(PeerAddress machine, out ConnectionPlace? given)
    {
        given = null;
        SimTime now = clock.Now;
        ConnectionPlace[] own = [.. places.Where(place => place.Machine == machine)];
        if (own.Length >= Math.Max(1, most / 2))
        {
            given = FirstUnsafe(own, now);
            return given is not null;
        }

        if (places.Count < most)
        {
            return true;
        }

        IGrouping<PeerAddress, ConnectionPlace>[] loose = [.. places.Where(place => !place.IsHeld(now)).GroupBy(place => place.Machine)];
        int ownLoose = own.Count(place => !place.IsHeld(now));
        given = loose.Where(some => some.Key == machine || some.Count() > ownLoose).OrderByDescending(some => some.Count())
            .Select(some => some.Count() > ownLoose + 1 ? some.OrderBy(place => place.SafeUntil).First() : FirstUnsafe(some, now))
            .FirstOrDefault(place => place is not null);
        return given is not null;
    }

    private static ConnectionPlace? FirstUnsafe(IEnumerable<ConnectionPlace> some, SimTime now) =>
        some.Where(place => place.SafeUntil < now && !place.IsHeld(now)).OrderBy(place => place.SafeUntil).FirstOrDefault();
}
