using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text.RegularExpressions;
using FsCheck.Fluent;
using LagSim.Net.Protection;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;
using static LagSim.Tests.Wire.LayoutPage;
using static LagSim.Tests.Wire.PageDatagrams;
using static LagSim.Tests.Wire.PageSnapshots;

namespace LagSim.Tests.Wire;

/// <summary>docs/WIRE.md says what is true: datagrams and copies written from its tables, field by field in their order and types, are those of the library.</summary>
public sealed class WirePageTests
{
    private static readonly string[] Page = Read("WIRE.md");

    [Fact]
    public void Tables_WrittenFieldByField_AreTheDatagrams()
    {
        int checkedOnes = 0;
        foreach ((byte[] expected, Func<string[], byte[]> written) in Datagrams(60))
        {
            Assert.Equal(Convert.ToHexString(expected), Convert.ToHexString(written(Page)));
            checkedOnes++;
        }

        Assert.Equal(23 * 60, checkedOnes);
    }

    [Fact]
    public void Tables_OfCopyAndSnapshot_AreThoseOfWorlds()
    {
        int dense = 0, carried = 0, held = 0, inContact = 0;
        foreach (RandomWorld world in Enumerable.Range(1, 40).Select(seed => new RandomWorld(seed, hands: true, filters: seed % 4 < 2, sensors: seed % 2 == 0, rules: seed % 3 == 0)))
        {
            WorldSnapshot snapshot = world.OnTime().Snapshot(At(0.6));
            Assert.Equal(Convert.ToHexString(SnapshotFormat.Encode(snapshot)), Convert.ToHexString(Snapshot(Page, snapshot)));
            Assert.Equal(
                Convert.ToHexString(SessionSnapshot.Encode(world.Scene, snapshot)), Convert.ToHexString(Copy(Page, world.Scene, snapshot)));
            dense += snapshot.Bodies.Count(b => b.Law == MotionLaw.RungeKutta4);
            carried += snapshot.Bodies.Count(b => b.SupportCount > 0);
            held += snapshot.Bodies.Count(b => b.Law == MotionLaw.Held);
            inContact += snapshot.Bodies.Count(b => b.Contacts.Length > 0);
        }

        // Else nothing was shown.
        Assert.True(dense > 10 && carried > 3 && held > 5 && inContact > 3, $"{dense} {carried} {held} {inContact}");
    }

    [Fact]
    public void Tables_WithTwoRowsSwappedOrOneLess_AreSeenToFail()
    {
        (byte[] Expected, Func<string[], byte[]> Written)[] all = [.. Datagrams(25), .. Snapshots()];
        int rows = 0;
        for (int i = 0; i < Page.Length; i++)
        {
            if (IsField(Page, i))
            {
                string[] without = [.. Page[..i], .. Page[(i + 1)..]];
                Assert.True(all.Any(one => Differs(one, without)), $"without '{Page[i]}'");
                rows++;
            }

            if (IsField(Page, i) && IsField(Page, i + 1) && !Page[i].Contains("padding", StringComparison.Ordinal))
            {
                string[] swapped = [.. Page[..i], Page[i + 1], Page[i], .. Page[(i + 2)..]];
                Assert.True(all.Any(one => Differs(one, swapped)), $"with '{Page[i]}' below the next");
            }
        }

        Assert.Equal(3 + 3 + 7 + 2 + 17 + 4 + 6 + 4 + 3 + 7 + 5 + 3 + 6 + 14 + 4 + 3 + 2 + 3 + 2 + 2 + 3 + 5 + 3 + 34 + 6 + 5 + 4 + 10 + 3 + 3 + 3, rows);
    }

    [Fact]
    public void Numbers_OfThePage_AreThoseOfTheCode()
    {
        string page = string.Join("\n", Page);
        Assert.StartsWith($"# The wire format, version {WireFormat.Version}\n", page, StringComparison.Ordinal);
        Dictionary<DatagramType, int> lengths = new()
        {
            [DatagramType.ConnectRequest] = WireFormat.ConnectRequestBytes,
            [DatagramType.Welcome] = WireFormat.WelcomeBytes,
            [DatagramType.Refusal] = WireFormat.RefusalBytes,
            [DatagramType.Update] = WireFormat.EmptyUpdateBytes,
            [DatagramType.Leave] = WireFormat.LeaveBytes,
            [DatagramType.Challenge] = WireFormat.ChallengeBytes,
            [DatagramType.Join] = WireFormat.JoinBytes,
            [DatagramType.SnapshotRequest] = WireFormat.SnapshotRequestBytes,
            [DatagramType.SnapshotChunk] = WireFormat.EmptySnapshotChunkBytes + 1,
            [DatagramType.DesyncQuery] = WireFormat.DesyncQueryBytes,
            [DatagramType.DesyncReport] = WireFormat.EmptyDesyncReportBytes,
            [DatagramType.Seat] = WireFormat.SeatBytes,
            [DatagramType.Move] = WireFormat.MoveBytes,
            [DatagramType.MoveChallenge] = WireFormat.MoveChallengeBytes,
            [DatagramType.SecureJoin] = WireFormat.SecureJoinBytes,
            [DatagramType.SecureWelcome] = WireFormat.SecureWelcomeBytes,
            [DatagramType.SecureRefusal] = WireFormat.SecureRefusalBytes,
            [DatagramType.Reset] = WireFormat.ResetBytes,
            [DatagramType.Roster] = WireFormat.EmptyRosterBytes + RosterEntry.GoneBytes,
            [DatagramType.RosterReceived] = WireFormat.RosterReceivedBytes,
            [DatagramType.KeyExchange] = WireFormat.KeyExchangeBytes,
            [DatagramType.KeyExchangeReply] = WireFormat.KeyExchangeBytes,
            [DatagramType.Sealed] = SealedDatagram.PrologueBytes + 1 + IDatagramCipher.TagBytes,
        };
        Assert.Equal($"{WireFormat.Version}", HeaderVersion(Page));
        Assert.NotEqual($"{WireFormat.Version}", HeaderVersion([.. Page.Select(line => line == $"| u8 | version | {WireFormat.Version} |" ? "| u8 | version | 10 |" : line)])); // the control
        foreach (DatagramType type in Enum.GetValues<DatagramType>().Where(type => type != DatagramType.None))
        {
            Assert.Contains($"{(int)type} {type}", Table(Page, "## Header")[2].Value, StringComparison.Ordinal);
            Assert.Single(Page, line => line.StartsWith($"## {(int)type} {type}, {lengths[type]} ", StringComparison.Ordinal));
        }

        AssertWords<RefusalReason>(Table(Page, "## 3 Refusal")[1].Value);
        AssertWords<Verdict>(Table(Page, "## 4 Update").Single(row => row.Field == "entry verdict").Value);
        Assert.Contains($"0 to {UpdateDatagram.MaxEntries};", page, StringComparison.Ordinal);
        Assert.Contains($"{SnapshotChunkDatagram.MaxData.ToString("N0", CultureInfo.InvariantCulture)} bytes", page, StringComparison.Ordinal);
        Assert.Contains($"1 to {SessionSnapshot.MaxBytes.ToString("N0", CultureInfo.InvariantCulture)} |", page, StringComparison.Ordinal);
        Assert.Contains($"0 to {BodySnapshot.MaxSupports} |", page, StringComparison.Ordinal);
        foreach (string refusal in Enum.GetNames<WireRefusal>().Where(name => name != nameof(WireRefusal.None)))
        {
            Assert.Matches($@"\| ([A-Za-z, ]*, )?{refusal}(, [A-Za-z]*)? \|", page);
        }
    }

    private static string HeaderVersion(string[] page) => Table(page, "## Header").Single(row => row.Field == "version").Value;

    private static void AssertWords<T>(string value)
        where T : struct, Enum
    {
        foreach (T one in Enum.GetValues<T>())
        {
            string words = Regex.Replace(one.ToString(), "(?<!^)([A-Z])", " $1").ToLowerInvariant();
            Assert.Contains(string.Create(CultureInfo.InvariantCulture, $"{Convert.ToInt32(one, CultureInfo.InvariantCulture)} {words}"), value, StringComparison.Ordinal);
        }
    }

    private static bool Differs((byte[] Expected, Func<string[], byte[]> Written) one, string[] page)
    {
        try
        {
            return !one.Expected.AsSpan().SequenceEqual(one.Written(page));
        }
        catch (Exception wrong) when (wrong is KeyNotFoundException or InvalidCastException or IndexOutOfRangeException or FormatException or OverflowException)
        {
            return true; // a field that is not of this table
        }
    }
}
