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
                    SnapshotRequestDatagram ask = download.Ask(1, 1, now, Trips, Timeout);
                    for (int n = 0; n < SnapshotRequestDatagram.MaxChunks; n++)
                    {
                        if ((ask.Wanted >> n & 1) != 0)
                        {
                            askedTwice += asked.Add(ask.First + (uint)n) ? 0 : 1;
                            onTheWay.AddRange(Enumerable.Repeat(ask.First + (uint)n, random.Next(4) switch { 0 => 0, 1 => 2, _ => 1 }));
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
            SnapshotRequestDatagram ask = download.Ask(1, 1, now, Trips, Timeout);
            asked += BitOperations.PopCount(ask.Wanted);
            requests++;
            for (int n = 0; n < SnapshotRequestDatagram.MaxChunks; n++)
            {
                if ((ask.Wanted >> n & 1) != 0)
                {
                    Give(download, copy, ask.First + (uint)n, now);
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
        Assert.False(download.Take(new SnapshotChunkDatagram(1, 201, new byte[7]), SimTime.Zero)); // past the end
        Assert.False(download.Take(new SnapshotChunkDatagram(1, uint.MaxValue, new byte[7]), SimTime.Zero));
        Assert.False(download.Take(new SnapshotChunkDatagram(1, 64, copy.AsSpan(0, SnapshotChunkDatagram.MaxData)), SimTime.Zero)); // beyond the window
        Assert.False(download.Take(new SnapshotChunkDatagram(1, 0, copy.AsSpan(0, 5)), SimTime.Zero)); // of another length
        Assert.True(download.Take(new SnapshotChunkDatagram(1, 0, copy.AsSpan(0, SnapshotChunkDatagram.MaxData)), SimTime.Zero));
        Assert.False(download.Take(new SnapshotChunkDatagram(1, 0, copy.AsSpan(0, SnapshotChunkDatagram.MaxData)), SimTime.Zero)); // again
    }

    private static bool Give(SnapshotDownload download, byte[] copy, uint index, SimTime now)
    {
        int at = (int)index * SnapshotChunkDatagram.MaxData;
        return download.Take(new SnapshotChunkDatagram(1, index, copy.AsSpan(at, Math.Min(SnapshotChunkDatagram.MaxData, copy.Length - at))), now);
    }
}
