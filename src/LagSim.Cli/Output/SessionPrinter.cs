using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Reports;
using LagSim.Net.Carriers;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>A printer of a running session, line by line, and of its summary, as text or as JSON.</summary>
/// <remarks>With JSON the lines are progress and go to the error stream.</remarks>
internal sealed class SessionPrinter
{
    private readonly ToolConsole console;
    private readonly bool json;
    private readonly string command;
    private readonly ulong seed;
    private readonly double? forSeconds;
    private readonly string? recordFile;
    private readonly List<(double Seconds, CommittedState State)> states = [];
    private ClockReading? clock;
    private string here = "";
    private CommittedWorld? committed;

    /// <param name="console">The console to print to.</param>
    /// <param name="json">Whether the summary is JSON.</param>
    /// <param name="command">The current command, <c>host</c> or <c>join</c>.</param>
    /// <param name="seed">The seed of the run.</param>
    /// <param name="seconds">The duration, in seconds; null until cancelled.</param>
    /// <param name="recordFile">The file of the recording; null for none.</param>
    internal SessionPrinter(ToolConsole console, bool json, string command, ulong seed, double? seconds, string? recordFile)
    {
        this.console = console;
        this.json = json;
        this.command = command;
        this.seed = seed;
        forSeconds = seconds;
        this.recordFile = recordFile;
    }

    /// <summary>The address at which a host can be reached; null for a client.</summary>
    internal string? ListeningOn { get; init; }

    /// <summary>The address of the page at which browsers join; null for none.</summary>
    internal string? Page { get; init; }

    /// <summary>The address of a WebSocket that a client joins by; null for UDP, whose links tell their address.</summary>
    internal string? Server { get; init; }

    /// <summary>The addresses with fingerprint that clients join; none for a client, and for a session without protection.</summary>
    internal IReadOnlyList<string> Addresses { get; init; } = [];

    internal LinkTable Links { get; } = new();

    private string Place(PeerAddress address) => Server ?? address.ToString();

    /// <summary>Prints a line and flushes it.</summary>
    internal void Line(string text)
    {
        TextWriter to = json ? console.Error : console.Output;
        to.WriteLine(text);
        to.Flush();
    }

    /// <summary>Prints a problem.</summary>
    internal void Problem(string sentence) => console.Error.WriteLine(sentence);

    /// <summary>Reports that there is no summary, since there was no world. The reason is on the error stream.</summary>
    internal void Failed(string why, int exitCode)
    {
        if (json)
        {
            Failure.Write(console.Output, command, seed, why, exitCode);
        }
    }

    internal void State(in CommittedState state, SimDuration sinceStart, ClockReading? reading, CommittedWorld world)
    {
        double seconds = sinceStart.ToSeconds();
        states.Add((seconds, state));
        Line(string.Create(CultureInfo.InvariantCulture, $"T {seconds} s state {state.StateHash:x16} events {state.EventHash:x16}"));
        if (reading is ClockReading now)
        {
            clock = now;
            Line(string.Create(
                CultureInfo.InvariantCulture,
                $"clock offset {now.Offset.ToMilliseconds():0.0000} ms bound {now.Bound.ToMilliseconds():0.0000} ms delay"
                    + $" {now.Delay.ToMilliseconds():0.0000} ms"));
        }

        committed = world;
        if (world.RulesLine is string line)
        {
            Line(line);
        }
    }

    /// <summary>Prints that a client joined this host.</summary>
    internal void Came(LinkTraffic link)
    {
        Links.Add(link);
        Progress($"peer {link.Peer} at {Place(link.Address)} came");
    }

    /// <summary>Prints that a client is gone.</summary>
    internal void Gone(LinkTraffic link)
    {
        Links.End(link);
        Progress($"peer {link.Peer} at {Place(link.Address)} is gone");
    }

    /// <summary>Prints who is in the session, if that is another line than the last.</summary>
    internal void Here(IReadOnlyList<RosterMember> roster)
    {
        string line = $"here: {string.Join(", ", roster.Select(one => $"{one}{(one.SilentSince is null ? "" : " (silent)")}"))}";
        if (roster.Count > 0 && line != here)
        {
            here = line;
            Line(line);
        }
    }

    /// <summary>Takes a sample of the links, and reports a client's first one.</summary>
    internal void LookAt(IReadOnlyList<LinkTraffic> links)
    {
        foreach (LinkTraffic link in links)
        {
            if (!Links.LookAt(link))
            {
                Links.Add(link);
                Progress($"in as a peer of the host at {Place(link.Address)}");
            }
        }
    }

    /// <summary>Prints the summary. The session's thread must have stopped.</summary>
    internal void Summary(Session session, IEnumerable<(string Name, long Count)> carried, SessionRecorder? recorder)
    {
        if (json)
        {
            CommittedState? last = states.Count > 0 ? states[^1].State : null;
            JsonDocumentWriter.Write(
                console.Output, command, seed, session.Scene!.Name, session.Scene.Hash, last?.StateHash, document => Write(document, session, carried, recorder));
        }
        else
        {
            WriteText(session, carried, recorder);
        }
    }

    private static IEnumerable<(string Name, long Count)> Counts(SessionCounters counters, IEnumerable<(string Name, long Count)> carried) =>
    [
        ("datagrams_sent", counters.DatagramsSent), ("datagrams_received", counters.DatagramsReceived), ("datagrams_malformed", counters.DatagramsMalformed),
        ("datagrams_ignored", counters.DatagramsIgnored), ("datagrams_forged", counters.DatagramsForged),
        .. carried, ("events_forged", counters.EventsForged), ("events_deferred", counters.EventsDeferred),
        ("events_lost", counters.EventsLost), ("events_unanswered", counters.EventsUnanswered), ("renewals", counters.Renewals),
    ];

    private void Progress(string text)
    {
        console.Error.WriteLine(text);
        console.Error.Flush();
    }

    private void WriteText(Session session, IEnumerable<(string Name, long Count)> carried, SessionRecorder? recorder)
    {
        TextWriter to = console.Output;
        Scene scene = session.Scene!;
        SessionCounters counters = session.Counters;
        to.WriteLine(string.Create(
            CultureInfo.InvariantCulture, $"lagsim {ToolVersion.Text}   {command} {scene.Name}   scene {scene.Hash:x16}   peer {session.Peer}"));
        to.WriteLine($"ended: {session.EndReason}");
        to.WriteLine(states.Count == 0
            ? "nothing was committed"
            : string.Create(CultureInfo.InvariantCulture, $"last committed: {states[^1].Seconds} s, {states[^1].State}"));
        to.WriteLine($"events: {counters.EventsAccepted} accepted, {counters.EventsRefused} refused; heals: {counters.Heals}");
        if (session is ClientSession client)
        {
            to.WriteLine($"states held against the host's: {counters.StatesAgreed} agreed, {counters.StatesDiffered} differed");
            if (client.Divergence is Divergence divergence)
            {
                to.WriteLine($"first difference: {divergence}");
            }
        }

        foreach (LinkRow row in Links.Rows)
        {
            to.WriteLine(
                $"peer {row.Peer} at {Place(row.Address)}: {PerSecond(row.SentPerSecond)} sent, {PerSecond(row.ReceivedPerSecond)} received, payload alone; "
                + $"round trip {NumberText.Short(row.Last.RoundTrip.ToMilliseconds())} ms");
        }

        (string Name, long Count)[] counted = [.. Counts(counters, carried).Where(c => c.Count != 0)];
        if (counted.Length > 0)
        {
            to.WriteLine($"counted: {string.Join(", ", counted.Select(c => $"{c.Name.Replace('_', ' ')} {c.Count}"))}");
        }

        if (recordFile is string file)
        {
            string files = recorder?.Files.Count > 1 ? string.Join(", ", recorder.Files) : file;
            to.WriteLine(recorder?.Failure is null ? $"recorded in {files}" : $"recorded in {files} only in part: {recorder.Failure}");
        }

        to.Flush();
    }

    private static string PerSecond(double bytes) => double.IsNaN(bytes) ? "- B/s" : $"{NumberText.Short(bytes)} B/s";

    private void Write(Utf8JsonWriter document, Session session, IEnumerable<(string Name, long Count)> carried, SessionRecorder? recorder)
    {
        SessionCounters counters = session.Counters;
        document.WriteNumber("peer", session.Peer);
        document.WriteString("listening_on", ListeningOn);
        document.WriteString("page", Page);
        document.WriteBoolean("protected", session.IsProtected);
        document.WriteStartArray("addresses");
        foreach (string address in Addresses)
        {
            document.WriteStringValue(address);
        }

        document.WriteEndArray();
        JsonDocumentWriter.Number(document, "for_s", forSeconds);
        document.WriteString("ended_by", Words(session.EndedBy));
        document.WriteString("end_reason", session.EndReason);
        JsonDocumentWriter.Number(document, "committed_s", states.Count > 0 ? states[^1].Seconds : null);
        document.WriteString("event_hash", JsonDocumentWriter.Hash(states.Count > 0 ? states[^1].State.EventHash : null));
        document.WriteStartArray("states");
        foreach ((double seconds, CommittedState state) in states)
        {
            document.WriteStartObject();
            document.WriteNumber("t_s", seconds);
            document.WriteString("state_hash", JsonDocumentWriter.Hash(state.StateHash));
            document.WriteString("event_hash", JsonDocumentWriter.Hash(state.EventHash));
            document.WriteEndObject();
        }

        document.WriteEndArray();
        CommittedWorld.Write(document, session.Scene!, committed);
        document.WriteNumber("states_agreed", counters.StatesAgreed);
        document.WriteNumber("states_differed", counters.StatesDiffered);
        document.WriteString("divergence", (session as ClientSession)?.Divergence?.ToString());
        document.WriteNumber("events_accepted", counters.EventsAccepted);
        document.WriteNumber("events_refused", counters.EventsRefused);
        document.WriteNumber("heals", counters.Heals);
        JsonDocumentWriter.Number(document, "clock_offset_ms", clock?.Offset.ToMilliseconds());
        JsonDocumentWriter.Number(document, "clock_bound_ms", clock?.Bound.ToMilliseconds());
        JsonDocumentWriter.Number(document, "delay_ms", clock?.Delay.ToMilliseconds());
        document.WriteString("role", session.Role.ToString().ToLowerInvariant());
        document.WriteStartArray("roster");
        foreach (RosterMember one in session.Roster)
        {
            document.WriteStartObject();
            document.WriteNumber("number", one.Number);
            document.WriteString("role", one.Role.ToString().ToLowerInvariant());
            document.WriteString("name", one.Name);
            document.WriteBoolean("silent", one.SilentSince is not null);
            document.WriteEndObject();
        }

        document.WriteEndArray();
        document.WriteStartArray("links");
        foreach (LinkRow row in Links.Rows)
        {
            document.WriteStartObject();
            document.WriteNumber("peer", row.Peer);
            document.WriteString("address", Place(row.Address));
            document.WriteNumber("sent_payload_bytes", row.Last.BytesSent);
            document.WriteNumber("received_payload_bytes", row.Last.BytesReceived);
            JsonDocumentWriter.Number(document, "sent_payload_bytes_per_s", row.SentPerSecond);
            JsonDocumentWriter.Number(document, "received_payload_bytes_per_s", row.ReceivedPerSecond);
            document.WriteNumber("round_trip_ms", row.Last.RoundTrip.ToMilliseconds());
            document.WriteEndObject();
        }

        document.WriteEndArray();
        document.WriteStartObject("counters");
        foreach ((string name, long count) in Counts(counters, carried))
        {
            document.WriteNumber(name, count);
        }

        document.WriteEndObject();
        JsonDocumentWriter.Number(document, "world_late_max_ms", session.World?.MaxRenderLateness.ToMilliseconds());
        document.WriteStartArray("costs");
        foreach (PlayerCost cost in (session as HostSession)?.Costs ?? [])
        {
            document.WriteStartObject();
            document.WriteNumber("player", cost.Player);
            document.WriteNumber("work", cost.Work);
            document.WriteNumber("most_at_once", cost.PeakWork);
            document.WriteEndObject();
        }

        document.WriteEndArray();
        document.WriteString("recording", recordFile);
        document.WriteString("recording_failure", recorder?.Failure);
        document.WriteStartArray("recordings");
        foreach (string file in recorder?.Files ?? [])
        {
            document.WriteStringValue(file);
        }

        document.WriteEndArray();
    }

    private static string Words(SessionEnd end) => end switch
    {
        SessionEnd.None => "nothing",
        SessionEnd.Left => "left",
        SessionEnd.HostEnded => "host-ended",
        SessionEnd.HostFailed => "host-failed",
        SessionEnd.Refused => "refused",
        SessionEnd.HostSilent => "host-silent",
        SessionEnd.Disconnected => "let-go",
        SessionEnd.Kicked => "kicked",
        SessionEnd.LinkTooSlow => "link-too-slow",
        _ => "failed",
    };
}
