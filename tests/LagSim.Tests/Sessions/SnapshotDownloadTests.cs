using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using LagSim.Net.Sessions.Clients;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A copy comes together whatever becomes of its pieces, and nothing else gets into it.</summary>
public sealed class SnapshotDownloadTests
{
    private static readonly SimDuration Timeout = SimDuration.FromMilliseconds(50);
    private static readonly RoundTrips Trips = new();
    private const uint Max = SnapshotChunkDatagram.MaxData;

    [Fact]
    public void Take_PiecesLostDoubledAndOutOfOrder_ComesTogetherWhole()
    {
        int doubled = 0, askedTwice = 0;
        for (int seed = 0; seed < 200; seed++)
        {
            Random random = new(seed);
            byte[] copy = new byte[1 + random.Next(seed % 3 == 0 ? 300_000 : 5_000)];
            random.NextBytes(copy);
            SimTime now = SimTime.Zero;
            SnapshotDownload download = new(copy.Length, now);
            List<uint> onTheWay = [];
            HashSet<uint> asked = [];
            while (!download.IsComplete)
            {
                Assert.True(now < SimTime.FromSeconds(600), $"seed {seed}");
                if (download.Due <= now)
                {
                    SnapshotRequestDatagram ask = download.Ask(1, now, SimTime.MinValue, Trips, Timeout);
                    for (int n = 0; n < SnapshotRequestDatagram.MaxChunks; n++)
                    {
                        if ((ask.Wanted >> n & 1) != 0)
                        {
                            uint offset = ask.First + (uint)(n * ask.ChunkBytes);
                            askedTwice += asked.Add(offset) ? 0 : 1;
                            onTheWay.AddRange(Enumerable.Repeat(offset, random.Next(4) switch { 0 => 0, 1 => 2, _ => 1 }));
                        }
                    }
                }

                if (onTheWay.Count > 0)
                {
                    int which = random.Next(Math.Min(20, onTheWay.Count));
                    doubled += Give(download, copy, onTheWay[which], now) ? 0 : 1;
                    onTheWay.RemoveAt(which);
                }

                now += SimDuration.FromMilliseconds(random.NextDouble() * 3);
            }

            Assert.True(copy.AsSpan().SequenceEqual(download.Bytes), $"seed {seed}");
            Assert.Equal(SessionSnapshot.HashOf(copy), SessionSnapshot.HashOf(download.Bytes));
            Assert.Equal(SimTime.MaxValue, download.Due);
        }

        Assert.True(doubled > 1000 && askedTwice > 1000, $"{doubled} {askedTwice}");
    }

    [Fact]
    public void Ask_WithoutLoss_AsksForEachPieceOnce()
    {
        byte[] copy = new byte[SnapshotChunkDatagram.MaxData * 500];
        SnapshotDownload download = new(copy.Length, SimTime.Zero);
        SimTime now = SimTime.Zero;
        int asked = 0, requests = 0;
        while (!download.IsComplete)
        {
            SnapshotRequestDatagram ask = download.Ask(1, now, SimTime.MinValue, Trips, Timeout);
            asked += BitOperations.PopCount(ask.Wanted);
            requests++;
            for (int n = 0; n < SnapshotRequestDatagram.MaxChunks; n++)
            {
                if ((ask.Wanted >> n & 1) != 0)
                {
                    Give(download, copy, ask.First + (uint)(n * ask.ChunkBytes), now);
                }
            }
        }

        Assert.Equal(500, asked);
        Assert.InRange(requests, 500 / SnapshotRequestDatagram.MaxChunks, 20);
    }

    [Fact]
    public void Take_WhatIsNotMissing_IsRefused()
    {
        byte[] copy = new byte[(SnapshotChunkDatagram.MaxData * 200) + 7];
        SnapshotDownload download = new(copy.Length, SimTime.Zero);
        Assert.False(download.Take(new SnapshotChunkDatagram(1, 201 * Max, new byte[7]), SimTime.Zero)); // past the end
        Assert.False(download.Take(new SnapshotChunkDatagram(1, uint.MaxValue, new byte[7]), SimTime.Zero));
        Assert.False(download.Take(new SnapshotChunkDatagram(1, 64 * Max, copy.AsSpan(0, SnapshotChunkDatagram.MaxData)), SimTime.Zero)); // beyond the window
        Assert.False(download.Take(new SnapshotChunkDatagram(1, 0, copy.AsSpan(0, 5)), SimTime.Zero)); // of another length
        Assert.True(download.Take(new SnapshotChunkDatagram(1, 0, copy.AsSpan(0, SnapshotChunkDatagram.MaxData)), SimTime.Zero));
        Assert.False(download.Take(new SnapshotChunkDatagram(1, 0, copy.AsSpan(0, SnapshotChunkDatagram.MaxData)), SimTime.Zero)); // again
    }

    [Fact]
    public void Ask_WhereNoLongChunkComesThoughTheHostIsHeard_AsksForShortOnes()
    {
        byte[] copy = new byte[5000];
        new Random(1).NextBytes(copy);
        SnapshotDownload download = new(copy.Length, SimTime.Zero);
        (List<int> lengths, SimTime now) = ([], SimTime.Zero);
        while (!download.IsComplete)
        {
            Assert.True(now < SimTime.FromSeconds(5));
            SnapshotRequestDatagram ask = download.Ask(1, now, now - SimDuration.OneTick, Trips, Timeout);
            lengths.Add(ask.ChunkBytes);
            foreach (int n in Enumerable.Range(0, SnapshotRequestDatagram.MaxChunks).Where(n => (ask.Wanted >> n & 1) != 0 && ask.ChunkBytes < 600))
            {
                Assert.True(Give(download, copy, ask.First + (uint)(n * ask.ChunkBytes), now, ask.ChunkBytes));
            }

            now = SimTime.Max(now, download.IsComplete ? now : download.Due);
        }

        Assert.Equal(copy, download.Bytes.ToArray());
        Assert.Equal([.. Enumerable.Repeat(1161, 5), 509], lengths.Take(6));
        Assert.All(lengths.Skip(5), length => Assert.Equal(509, length));
    }

    [Fact]
    public void Ask_WhereNothingOfTheHostComes_AsksForNothingShorter()
    {
        SnapshotDownload download = new(5000, SimTime.Zero);
        for (SimTime now = SimTime.Zero; now < SimTime.FromSeconds(60); now = download.Due)
        {
            Assert.Equal(1161, download.Ask(1, now, SimTime.MinValue, Trips, Timeout).ChunkBytes);
        }
    }

    [Fact]
    public void Ask_WhereShortChunksDoNotComeEither_TriesLongOnesAgain()
    {
        SnapshotDownload download = new(5000, SimTime.Zero);
        List<int> lengths = [];
        for (SimTime now = SimTime.Zero; lengths.Count < 11; now = download.Due)
        {
            lengths.Add(download.Ask(1, now, now - SimDuration.OneTick, Trips, Timeout).ChunkBytes);
        }

        Assert.Equal((509, 1161), (lengths[5], lengths[10]));
        Assert.Equal(" The host's other datagrams arrive, but none of the copy does, whether long or short.", download.Size.Sentence);
    }

    [Fact]
    public void Take_LongChunkThatWasLate_GoesBackToLongOnes()
    {
        byte[] copy = new byte[5000];
        new Random(2).NextBytes(copy);
        SnapshotDownload download = new(copy.Length, SimTime.Zero);
        SimTime now = SimTime.Zero;
        while (download.Ask(1, now, now - SimDuration.OneTick, Trips, Timeout).ChunkBytes > 600)
        {
            now = download.Due;
        }

        Assert.True(Give(download, copy, 509, now, 509)); // a short one, early
        Assert.True(Give(download, copy, 0, now));
        Assert.Equal(1161, download.Received);
        for (int rounds = 0; !download.IsComplete; rounds++)
        {
            Assert.True(rounds < 10);
            SnapshotRequestDatagram ask = download.Ask(1, now, now, Trips, Timeout);
            Assert.Equal(1161, ask.ChunkBytes);
            foreach (int n in Enumerable.Range(0, SnapshotRequestDatagram.MaxChunks).Where(n => (ask.Wanted >> n & 1) != 0))
            {
                Give(download, copy, ask.First + (uint)(n * ask.ChunkBytes), now);
            }
        }

        Assert.Equal(copy, download.Bytes.ToArray());
    }

    private static bool Give(SnapshotDownload download, byte[] copy, uint offset, SimTime now, int length = SnapshotChunkDatagram.MaxData) =>
        download.Take(new SnapshotChunkDatagram(1, offset, copy.AsSpan((int)offset, Math.Min(length, copy.Length - (int)offset))), now);
}
