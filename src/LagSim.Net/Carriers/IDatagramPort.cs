using System;

namespace LagSim.Net.Carriers;

/// <summary>Carries datagrams between peers, and nothing more: no connection, no order, no guarantee of delivery.</summary>
/// <remarks>
/// <see cref="Send"/> and <see cref="TryReceive"/> are for one thread, the session's. <see cref="Arrived"/> may be raised on any thread; it
/// only wakes the session's.
/// </remarks>
public interface IDatagramPort : IDisposable
{
    /// <summary>The longest datagram that is sent or received, in bytes. A longer one is dropped and counted, never truncated.</summary>
    public const int MaxDatagramBytes = 1200;

    /// <summary>This port's address, as others on the same machine or network can reach it.</summary>
    PeerAddress LocalAddress { get; }

    /// <summary>Raised after a datagram arrived, on any thread. Handlers must return at once and not throw.</summary>
    event Action? Arrived;

    /// <summary>
    /// Hands a datagram to the network. Never blocks; a datagram that the network does not accept is lost, as any may be.
    /// </summary>
    /// <exception cref="ArgumentException">
    /// The datagram is empty or longer than <see cref="MaxDatagramBytes"/>, or the address is none.
    /// </exception>
    void Send(ReadOnlySpan<byte> datagram, PeerAddress to);

    /// <summary>Takes the next datagram that arrived, if there is one. Never blocks.</summary>
    /// <param name="buffer">At least <see cref="MaxDatagramBytes"/> long.</param>
    /// <param name="length">The datagram's length, 1 to <see cref="MaxDatagramBytes"/>.</param>
    /// <param name="from">Its sender.</param>
    /// <returns>False if nothing is waiting.</returns>
    bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from);

    /// <summary>Is told by a host's session, each time it hears a client that has a place in it, where that client is. Whoever wraps a port
    /// passes it on.</summary>
    /// <remarks>Only the session knows who is in. A carrier of limited connections has to know, so that strangers do not take the places of
    /// those; for any other there is nothing to do. Called on the session's thread; must return at once and not throw.</remarks>
    /// <param name="peer">The client's address.</param>
    void NoteSeated(PeerAddress peer)
    {
    }
}
