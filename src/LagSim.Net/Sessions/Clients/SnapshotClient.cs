using System;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Downloads a snapshot of the scene and world from the host, chunk by chunk, and checks it against the announced hash.</summary>
internal sealed class SnapshotClient(
    JoinAttempts attempts, HostConnection connection, SharedWorld world, SessionStatus status, DatagramSender sender,
    SessionCounters counters, IClock clock, SceneCode code)
{
    /// <summary>The longest round trip to assume before one is measured.</summary>
    private static readonly SimDuration MaxTripGuess = SimDuration.FromMilliseconds(400);

    /// <summary>When to request the next chunks.</summary>
    internal SimTime Due => attempts.Current?.Download?.Due ?? SimTime.MaxValue;

    /// <summary>Requests chunks if it is time to.</summary>
    internal void Tend(SimTime now)
    {
        if (attempts.Current is not JoinAttempt { Download: SnapshotDownload download } attempt || download.Due > now)
        {
            return;
        }

        UpdateLink link = connection.Link!;
        SimDuration guessed = attempt.Took < MaxTripGuess ? attempt.Took : MaxTripGuess;
        Span<byte> bytes = stackalloc byte[WireFormat.SnapshotRequestBytes];
        SnapshotRequestDatagram request = download.Ask(link.SessionId, now, link.Heard, link.Trips, guessed);
        link.Path.Bytes = request.ChunkBytes + WireFormat.EmptySnapshotChunkBytes + WireFormat.SealBytes;
        sender.Send(bytes.Slice(0, request.Encode(bytes)), link);
    }

    internal void OnSnapshotChunk(in SnapshotChunkDatagram chunk, int length)
    {
        SimTime now = clock.Now;
        if (connection.Link is not UpdateLink link || attempts.Current is not JoinAttempt { Download: SnapshotDownload download } attempt
            || chunk.SessionId != link.SessionId || !download.Take(chunk, now))
        {
            counters.DatagramsIgnored++;
            return;
        }

        link.NoteHeard(now);
        link.CountReceived(length);
        if (!download.IsComplete)
        {
            return;
        }

        string? error = null;
        if (SessionSnapshot.HashOf(download.Bytes) != attempt.CopyHash)
        {
            error = "its hash is another one than was announced.";
        }
        else if (SessionSnapshot.TryDecode(download.Bytes, code, world.Scene, out SessionSnapshot? snapshot, out error))
        {
            attempt.Snapshot = snapshot;
            world.Scene = snapshot.Scene;
            link.Flush(now);
        }

        attempt.Download = null;
        if (error is not null)
        {
            connection.Farewell(isChosen: false);
            status.End(SessionEnd.Failed, $"The copy of the world that the {connection.Name} sent cannot be used: {error}");
        }
    }
}
