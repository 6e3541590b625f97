using LagSim.Net.Sessions.Links;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>How far the host speaks to a client by itself, without being asked.</summary>
/// <remarks>
/// While a client joins, it is the one that asks, again and again. A host that heard nothing after a few answers waits for it: it may have
/// vanished, or its address may be of somebody who is not a client any more.
/// </remarks>
internal sealed class SpeakingLimit(UpdateLink link)
{
    /// <summary>How many datagrams a joining client is sent after the last that arrived from it.</summary>
    private const int MostUnheard = 5;

    private SimTime heard; // when the last one arrived, as of the last that was sent
    private int unheard; // how many were sent since

    /// <summary>Whether an update from the client has arrived. Until then it is sent none.</summary>
    internal bool HasWritten { get; set; }

    /// <summary>Whether the client knows its number: an update with it has arrived.</summary>
    internal bool IsIn { get; set; }

    /// <summary>Whether the host may send to the client by itself.</summary>
    internal bool IsAllowed => HasWritten && (IsIn || link.Heard != heard || unheard < MostUnheard);

    /// <summary>By what to multiply the pause after the next datagram: it doubles with each that a joining client does not answer.</summary>
    internal int Patience => IsIn || link.Heard != heard ? 1 : 1 << unheard;

    /// <summary>Records that the client was sent a datagram.</summary>
    internal void NoteSent()
    {
        unheard = link.Heard == heard ? unheard + 1 : 1;
        heard = link.Heard;
    }
}
