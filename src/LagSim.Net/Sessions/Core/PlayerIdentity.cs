namespace LagSim.Net.Sessions.Core;

/// <summary>This peer's number in the session, and the sequence number of its newest event.</summary>
internal sealed class PlayerIdentity
{
    /// <summary>The peer's number; 0 for the host, and for a client that has none yet.</summary>
    internal byte Number { get; private set; }

    /// <summary>The sequence number of the newest event; those of former holders of the number count.</summary>
    internal uint LastSequence { get; private set; }

    /// <summary>Takes the number that the host gave.</summary>
    internal void Take(byte number, uint lastSequence) => (Number, LastSequence) = (number, lastSequence);

    /// <summary>Counts an event.</summary>
    internal void NoteEvent() => LastSequence++;
}
