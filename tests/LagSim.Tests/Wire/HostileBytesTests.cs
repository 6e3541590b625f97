using System;
using System.Collections.Generic;
using System.Linq;
using FsCheck.Fluent;
using LagSim.Events;
using LagSim.Net.Wire;
using Xunit;

namespace LagSim.Tests.Wire;

public class HostileBytesTests
{
    private const int Trials = 200_000;

    private readonly UpdateDatagram scratch = new();

    [Fact]
    public void TryDecode_EveryTruncation_IsRefusedAsTooShort()
    {
        foreach (byte[] whole in Valid(20))
        {
            for (int length = 0; length < whole.Length; length++)
            {
                Assert.Null(AnyDatagram.Again(whole.AsSpan(0, length), scratch, out WireRefusal refusal));
                Assert.Equal(WireRefusal.TooShort, refusal);
            }
        }
    }

    [Fact]
    public void TryDecode_EveryTrailingByte_IsRefused()
    {
        foreach (byte[] whole in Valid(20))
        {
            byte[] longer = new byte[whole.Length + 1];
            whole.CopyTo(longer, 0);
            for (int value = 0; value <= 255; value++)
            {
                longer[^1] = (byte)value;
                Assert.Null(AnyDatagram.Again(longer, scratch, out WireRefusal refusal));
                Assert.Equal(longer.Length > WireFormat.MaxPlainBytes ? WireRefusal.TooLong : WireRefusal.TrailingBytes, refusal);
            }
        }
    }

    [Fact]
    public void TryDecode_RandomBytes_NeverThrows()
    {
        Random random = new(1);
        byte[] buffer = new byte[1300];
        int accepted = 0;
        for (int i = 0; i < Trials; i++)
        {
            Span<byte> bytes = buffer.AsSpan(0, random.Next(i % 2 == 0 ? 100 : buffer.Length));
            random.NextBytes(bytes);
            if (i % 4 != 0 && bytes.Length >= WireFormat.HeaderBytes)
            {
                new byte[] { 0x53, 0x4C, WireFormat.Version, (byte)random.Next(1, (int)DatagramType.KeyExchangeReply + 1) }.CopyTo(bytes); // past the header, or it tests nothing else
            }

            accepted += Canonical(bytes) ? 1 : 0;
        }

        Assert.True(accepted > 0, "Nothing was accepted: the bytes no longer reach the decoders.");
    }

    [Fact]
    public void TryDecode_MutatedDatagrams_NeverThrowsAndWhatIsAcceptedIsCanonical()
    {
        Random random = new(2);
        byte[][] valid = Valid(200).ToArray();
        int accepted = 0, refused = 0;
        for (int i = 0; i < Trials; i++)
        {
            byte[] bytes = Mutation.Of(valid[random.Next(valid.Length)], random);

            bool canonical = Canonical(bytes);
            accepted += canonical ? 1 : 0;
            refused += canonical ? 0 : 1;
        }

        Assert.True(accepted > Trials / 10 && refused > Trials / 10, $"{accepted} accepted, {refused} refused: the mutations say little.");
    }

    [Fact]
    public void TryDecode_Refused_LeavesTheUpdateCleared()
    {
        byte[] bytes = Valid(1).Last();
        Assert.True(scratch.TryDecode(bytes, out _));

        Assert.False(scratch.TryDecode(bytes.AsSpan(0, bytes.Length - 1), out _));

        Assert.Equal(AnyDatagram.Bytes(new UpdateDatagram().Encode), AnyDatagram.Bytes(scratch.Encode));
    }

    [Fact]
    public void TryDecode_ValidAndHostileUpdates_AllocatesNothing()
    {
        // What rules are told, and may keep, is the one thing that is copied.
        ILookup<int, byte[]> byTold = Valid(20).ToLookup(Told);
        Assert.Equal(0, Allocated(byTold[0]));
        foreach (IGrouping<int, byte[]> some in byTold.Where(group => group.Key > 0))
        {
            Assert.InRange(Allocated(some), 1, 2 * some.Count() * some.Key * (GameCommand.MaxBytes + 96));
        }
    }

    private int Told(byte[] bytes)
    {
        bool isUpdate = scratch.TryDecode(bytes, out _);
        return isUpdate ? scratch.Entries.ToArray().Count(entry => entry.Event.Kind is EventKind.Command or EventKind.Player) : 0;
    }

    private long Allocated(IEnumerable<byte[]> valid)
    {
        byte[][] all = valid.SelectMany(bytes => new[] { bytes, bytes[..^1] }).ToArray();
        DecodeAll(all);
        long before = GC.GetAllocatedBytesForCurrentThread();
        DecodeAll(all);
        return GC.GetAllocatedBytesForCurrentThread() - before;
    }

    private static IEnumerable<byte[]> Valid(int each) => new[]
    {
        WireGen.ConnectRequest.Select(request => AnyDatagram.Bytes(request.Encode)),
        WireGen.Challenge.Select(challenge => AnyDatagram.Bytes(challenge.Encode)),
        WireGen.SnapshotRequest.Select(request => AnyDatagram.Bytes(request.Encode)),
        WireGen.DesyncQuery.Select(query => AnyDatagram.Bytes(query.Encode)),
        WireGen.DesyncReport.Select(report => AnyDatagram.Bytes(report.Encode)),
        WireGen.Join.Select(join => AnyDatagram.Bytes(join.Encode)),
        WireGen.Welcome.Select(welcome => AnyDatagram.Bytes(welcome.Encode)),
        WireGen.Seat.Select(seat => AnyDatagram.Bytes(seat.Encode)),
        WireGen.Move.Select(move => AnyDatagram.Bytes(move.Encode)),
        WireGen.Refusal.Select(answer => AnyDatagram.Bytes(answer.Encode)),
        WireGen.Leave.Select(leave => AnyDatagram.Bytes(leave.Encode)),
        WireGen.Update.Select(update => AnyDatagram.Bytes(update.Encode)),
    }.SelectMany(kind => Gen.Sample(kind, 30, each));

    private void DecodeAll(byte[][] all)
    {
        foreach (byte[] bytes in all)
        {
            scratch.TryDecode(bytes, out _);
        }
    }

    /// <summary>Whether the bytes are accepted; then they are the one form of what they say, but for the sign of a zero.</summary>
    private bool Canonical(ReadOnlySpan<byte> bytes)
    {
        byte[]? again = AnyDatagram.Again(bytes, scratch, out WireRefusal refusal);
        Assert.Equal(again is null, refusal != WireRefusal.None);
        if (again is not null)
        {
            Assert.True(AnyDatagram.SameButForNegativeZero(bytes, again), Convert.ToHexString(bytes));
            Assert.Equal(again, AnyDatagram.Again(again, scratch, out _));
        }

        return again is not null;
    }
}
