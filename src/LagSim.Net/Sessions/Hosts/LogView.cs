using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// The log as sent to one client: its own events go back by number only. Those that were moved are sent in full, and those of a former holder
/// of its number.
/// </summary>
internal sealed class LogView : IEntrySource
{
    private readonly LogLines log;

    internal LogView(LogLines log) => this.log = log;

    internal Client? Reader { get; set; }

    public uint Last => Reader!.IsReady ? log.Count : Reader.Acknowledged;

    public UpdateEntry this[uint number] => EntryFor(Reader!, number);

    internal UpdateEntry EntryFor(Client reader, uint number)
    {
        LogEntry entry = log[number];
        return entry.Event.Peer == reader.Peer && entry.Event.Sequence > reader.FirstSequence && entry.Verdict != Verdict.Moved
            ? new UpdateEntry(entry.Verdict, entry.Event.Sequence)
            : new UpdateEntry(entry.Verdict, entry.Event);
    }
}
