using System;
using System.Linq;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Wire;

public class RoundTripTests
{
    [Fact]
    public void Encode_AnyJoin_DecodesToTheSame() => Holds(WireGen.Join, join =>
        JoinDatagram.TryDecode(AnyDatagram.Bytes(join.Encode), out JoinDatagram again, out WireRefusal refusal)
        && refusal == WireRefusal.None && again.Equals(join));

    [Fact]
    public void Encode_AnyConnectRequest_DecodesToTheSame() => Holds(WireGen.ConnectRequest, request =>
        ConnectRequestDatagram.TryDecode(AnyDatagram.Bytes(request.Encode), out ConnectRequestDatagram again, out _) && again.Equals(request));

    [Fact]
    public void Encode_AnyChallenge_DecodesToTheSame() => Holds(WireGen.Challenge, challenge =>
        ChallengeDatagram.TryDecode(AnyDatagram.Bytes(challenge.Encode), out ChallengeDatagram again, out _) && again.Equals(challenge));

    [Fact]
    public void Encode_AnySnapshotRequest_DecodesToTheSame() => Holds(WireGen.SnapshotRequest, request =>
        SnapshotRequestDatagram.TryDecode(AnyDatagram.Bytes(request.Encode), out SnapshotRequestDatagram again, out _) && again.Equals(request));

    [Fact]
    public void Encode_AnyDesyncQuery_DecodesToTheSame() => Holds(WireGen.DesyncQuery, query =>
        DesyncQueryDatagram.TryDecode(AnyDatagram.Bytes(query.Encode), out DesyncQueryDatagram again, out _) && again.Equals(query));

    [Fact]
    public void Encode_AnyDesyncReport_DecodesToTheSame() => Holds(WireGen.DesyncReport, report =>
        DesyncReportDatagram.TryDecode(AnyDatagram.Bytes(report.Encode), out DesyncReportDatagram again, out _)
        && (again.SessionId, again.IsWhole, again.Total, again.Index, again.LogIndex) == (report.SessionId, report.IsWhole, report.Total, report.Index, report.LogIndex)
        && again.Event.Equals(report.Event));

    [Fact]
    public void Encode_AnySnapshotChunk_DecodesToTheSame() => Holds(WireGen.Chunk, bytes =>
        SnapshotChunkDatagram.TryDecode(bytes, out SnapshotChunkDatagram again, out _)
        && bytes.AsSpan().SequenceEqual(AnyDatagram.ChunkBytes(again.SessionId, again.Offset, again.Data)));

    [Fact]
    public void Encode_AnyWelcome_DecodesToTheSame() => Holds(WireGen.Welcome, welcome =>
        WelcomeDatagram.TryDecode(AnyDatagram.Bytes(welcome.Encode), out WelcomeDatagram again, out _) && again.Equals(welcome));

    [Fact]
    public void Encode_AnyRefusal_DecodesToTheSame() => Holds(WireGen.Refusal, answer =>
        RefusalDatagram.TryDecode(AnyDatagram.Bytes(answer.Encode), out RefusalDatagram again, out _) && again.Equals(answer));

    [Fact]
    public void Encode_AnyLeave_DecodesToTheSame() => Holds(WireGen.Leave, leave =>
        LeaveDatagram.TryDecode(AnyDatagram.Bytes(leave.Encode), out LeaveDatagram again, out _) && again.Equals(leave));

    [Fact]
    public void Encode_AnySeat_DecodesToTheSame() => Holds(WireGen.Seat, seat =>
        SeatDatagram.TryDecode(AnyDatagram.Bytes(seat.Encode), out SeatDatagram again, out _)
        && (again.SessionId, again.Peer, again.LastSequence, again.Pass) == (seat.SessionId, seat.Peer, seat.LastSequence, seat.Pass)
        && (again.Earliest, again.PromiseMilliseconds) == (seat.Earliest, seat.PromiseMilliseconds));

    [Fact]
    public void Encode_AnyRoster_DecodesToTheSame()
    {
        RosterDatagram again = new();
        Holds(WireGen.Roster, roster =>
        {
            byte[] bytes = AnyDatagram.Bytes(roster.Encode);
            return bytes.Length == roster.EncodedLength && again.TryDecode(bytes, out _)
                && (again.SessionId, again.After, again.UpTo, again.Newest) == (roster.SessionId, roster.After, roster.UpTo, roster.Newest)
                && again.Entries.ToArray().Zip(roster.Entries.ToArray(), (a, b) => a.IsSame(b)).All(same => same)
                && again.Entries.Length == roster.Entries.Length;
        });
    }

    [Fact]
    public void Encode_AnyRosterReceived_DecodesToTheSame() => Holds(WireGen.RosterReceived, received =>
        RosterReceivedDatagram.TryDecode(AnyDatagram.Bytes(received.Encode), out RosterReceivedDatagram again, out _)
        && (again.SessionId, again.Peer, again.Revision) == (received.SessionId, received.Peer, received.Revision));

    [Fact]
    public void Encode_AnyMove_DecodesToTheSame() => Holds(WireGen.Move, move =>
        MoveDatagram.TryDecode(AnyDatagram.Bytes(move.Encode), out MoveDatagram again, out _)
        && (again.SessionId, again.Peer, again.Cookie) == (move.SessionId, move.Peer, move.Cookie));

    [Fact]
    public void Encode_AnyUpdate_DecodesToTheSame()
    {
        UpdateDatagram again = new();
        Holds(WireGen.Update, update =>
        {
            byte[] bytes = AnyDatagram.Bytes(update.Encode);
            return bytes.Length == update.EncodedLength && again.TryDecode(bytes, out _) && Same(update, again);
        });
    }

    [Fact]
    public void Write_AnyEvent_TakesItsEncodedLengthAndReadsTheSame() => Holds(WireGen.Event, what =>
    {
        byte[] bytes = new byte[EventFormat.MaxBytes];
        WireWriter writer = new(bytes);
        EventFormat.Write(ref writer, what);
        WireReader reader = new(bytes.AsSpan(0, writer.Position));
        ExternalEvent again = EventFormat.Read(ref reader);
        return writer.Position == EventFormat.EncodedLength(what) && reader.Finish(out _) && again.Equals(what);
    });

    [Fact]
    public void Encode_Join_GivesTheDocumentedBytes()
    {
        byte[] bytes = AnyDatagram.Bytes(
            new JoinDatagram(0x0102030405060708, new Token128(Counting(1)), new Token128(Counting(0x41)), 0x2200000000000000, 0x01020304, 5, new Token128(Counting(0x61)), 2, "Zoë").Encode);

        Assert.Equal(
            "534C0E07" + "0807060504030201" + "0102030405060708090A0B0C0D0E0F10" + "4142434445464748494A4B4C4D4E4F50" + "0000000000000022"
            + "04030201" + "05" + "6162636465666768696A6B6C6D6E6F70" + "02" + "045A6FC3AB",
            Convert.ToHexString(bytes));

        static byte[] Counting(int from) => Enumerable.Range(from, Token128.Bytes).Select(value => (byte)value).ToArray();
    }

    [Fact]
    public void Encode_UpdateWithASetVelocity_GivesTheDocumentedBytes()
    {
        UpdateDatagram update = new() { SessionId = 1, Peer = 2, Number = 3, Sent = SimTime.FromTicks(4), EventsReceived = 5, FirstIndex = 6 };
        update.Ready = true;
        update.TryAddHash(SimTime.FromTicks(7), 8);
        update.TryAdd(
            Verdict.Accepted, ExternalEvent.SetVelocity(SimTime.FromTicks(9), 2, 10, BodyId.FromPacked(11), new Vector3D(1, -0.0, 0)));

        const string None = "0000000000000080";
        Assert.Equal(
            "534C0E04" + "0100000000000000" + "02" + "03000000" + "0400000000000000" + "00000000" + "00000000" + None + None + "05000000" + "03"
            + "0700000000000000" + "0800000000000000" + "06000000" + "01"
            + "01" + "0A" + "02" + "0A000000" + "0900000000000000" + "0B00000000000000"
            + "000000000000F03F" + "0000000000000000" + "0000000000000000",
            Convert.ToHexString(AnyDatagram.Bytes(update.Encode)));
    }

    [Fact]
    public void EncodedLengths_OfTheFixedDatagrams_AreTheDocumentedOnes()
    {
        Assert.Equal(WireFormat.JoinBytes, AnyDatagram.Bytes(default(JoinDatagram).Encode).Length);
        Assert.Equal(WireFormat.ConnectRequestBytes, AnyDatagram.Bytes(default(ConnectRequestDatagram).Encode).Length);
        Assert.Equal(WireFormat.ChallengeBytes, AnyDatagram.Bytes(default(ChallengeDatagram).Encode).Length);
        Assert.Equal(WireFormat.SnapshotRequestBytes, AnyDatagram.Bytes(default(SnapshotRequestDatagram).Encode).Length);
        Assert.Equal(WireFormat.EmptySnapshotChunkBytes + 1, AnyDatagram.ChunkBytes(1, 2, [3]).Length);
        Assert.Equal(WireFormat.WelcomeBytes, AnyDatagram.Bytes(new WelcomeDatagram(1, 2, SimDuration.OneTick, SimDuration.OneTick, 5, 6, 7).Encode).Length);
        Assert.Equal(WireFormat.RefusalBytes, AnyDatagram.Bytes(new RefusalDatagram(1, RefusalReason.Full).Encode).Length);
        Assert.Equal(WireFormat.LeaveBytes, AnyDatagram.Bytes(new LeaveDatagram(1, 2, LeaveReason.Left).Encode).Length);
        Assert.Equal(WireFormat.SeatBytes, AnyDatagram.Bytes(new SeatDatagram(1, 2, 3, default).Encode).Length);
        Assert.Equal(WireFormat.EmptyRosterBytes, AnyDatagram.Bytes(new RosterDatagram().Encode).Length);
        Assert.Equal(WireFormat.RosterReceivedBytes, AnyDatagram.Bytes(default(RosterReceivedDatagram).Encode).Length);
        Assert.Equal(WireFormat.MoveBytes, AnyDatagram.Bytes(default(MoveDatagram).Encode).Length);
        Assert.Equal(WireFormat.EmptyUpdateBytes + WireFormat.StartBytes, AnyDatagram.Bytes(new UpdateDatagram { Start = SimTime.Zero }.Encode).Length);
        Assert.Equal(WireFormat.EmptyUpdateBytes, AnyDatagram.Bytes(new UpdateDatagram().Encode).Length);
    }

    private static void Holds<T>(Gen<T> values, Func<T, bool> property) =>
        Prop.ForAll(Arb.From(values), property).Check(WireGen.Config);

    private static bool Same(UpdateDatagram a, UpdateDatagram b)
    {
        bool same = a.SessionId == b.SessionId && a.Peer == b.Peer && a.Number == b.Number && a.Sent == b.Sent
            && a.EchoNumber == b.EchoNumber && a.EchoBits == b.EchoBits && a.EchoReceived == b.EchoReceived && a.Start == b.Start && a.Watermark == b.Watermark
            && a.EventsReceived == b.EventsReceived && a.Ready == b.Ready
            && a.HashTime == b.HashTime && a.StateHashes.SequenceEqual(b.StateHashes) && a.FirstIndex == b.FirstIndex
            && a.Entries.Length == b.Entries.Length;
        for (int i = 0; same && i < a.Entries.Length; i++)
        {
            same = a.Entries[i].Verdict == b.Entries[i].Verdict && a.Entries[i].IsOwn == b.Entries[i].IsOwn
                && a.Entries[i].Sequence == b.Entries[i].Sequence && a.Entries[i].Event.Equals(b.Entries[i].Event);
        }

        return same;
    }
}
