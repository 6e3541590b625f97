using System;
using System.Collections.Generic;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>
/// No entry is lost over a link that loses, delays and reorders datagrams and their acknowledgements as it likes; and what loses one is
/// noticed here.
/// </summary>
public sealed class SendWindowLossTests
{
    private const int Seeds = 60;

    /// <summary>What is wrong with the sender, on purpose.</summary>
    public enum Fault
    {
        None,
        ForgetsLosses,
        DropsWhenMerging,
    }

    [Theory]
    [InlineData(Fault.None, 0, 0)]
    [InlineData(Fault.ForgetsLosses, Seeds / 4, Seeds)]
    [InlineData(Fault.DropsWhenMerging, Seeds / 4, Seeds)]
    public void AnyLossesAndOrders_EveryEntryComes(Fault fault, int least, int most)
    {
        int incomplete = 0;
        for (int seed = 0; seed < Seeds; seed++)
        {
            incomplete += IsComplete(seed, fault) ? 0 : 1;
        }

        Assert.InRange(incomplete, least, most);
    }

    private static bool IsComplete(int seed, Fault fault)
    {
        Random random = new(seed);
        SendWindow window = new(0);
        SentDatagrams sent = new();
        UpdateDatagram update = new();
        Entries entries = new();
        HashSet<uint> came = [];
        List<(uint Number, uint First, uint Last)> onTheirWay = [];
        List<(uint Number, uint Received)> acknowledgements = [];
        uint received = 0, number = 0;
        SimTime now = SimTime.FromSeconds(1);
        SimDuration trip = SimDuration.FromMilliseconds(40);
        double loss = random.NextDouble() * 0.6;
        int copies = random.Next(3) == 0 ? LossRuns.MaxCopies : random.Next(1, 5);
        bool hasComfort = seed % 2 == 0; // repetition makes up for much of what is wrong
        for (int step = 0; step < 1500; step++)
        {
            now += SimDuration.FromMilliseconds(random.Next(8));
            bool isTail = step >= 500; // nothing new any more: only what was lost
            loss = isTail && step > 1000 ? 0 : loss;
            entries.Last += isTail ? 0 : (uint)random.Next(random.Next(10) == 0 ? 200 : 3);
            if (window.HasNeeded(entries) || random.Next(4) == 0)
            {
                update.Clear();
                window.Fill(update, entries, hasComfort && random.Next(3) == 0 ? random.Next(1000) : 0, 100, random.Next(-50, 1500), copies);
                (uint first, uint last) = (update.FirstIndex, update.FirstIndex + (uint)update.Held.Length - 1);
                Lose(sent.Add(++number, now, 100, first, last));
                if (random.NextDouble() >= loss)
                {
                    onTheirWay.Insert(random.Next(onTheirWay.Count + 1), (number, first, last));
                }
            }

            if (onTheirWay.Count > 0 && random.Next(3) > 0)
            {
                (uint which, uint first, uint last) = onTheirWay[0];
                onTheirWay.RemoveAt(0);
                bool drops = fault == Fault.DropsWhenMerging && last > first && random.Next(10) == 0;
                for (uint n = first; n <= (drops ? last - 1 : last) && last >= first; n++)
                {
                    came.Add(n);
                }

                while (came.Contains(received + 1))
                {
                    received++;
                }

                if (random.NextDouble() >= loss)
                {
                    acknowledgements.Insert(random.Next(acknowledgements.Count + 1), (which, received));
                }
            }

            if (acknowledgements.Count > 0)
            {
                (uint which, uint upTo) = acknowledgements[0];
                acknowledgements.RemoveAt(0);
                window.Acknowledge(upTo);
                sent.TryAcknowledge(which, out _);
                while (sent.TryTakeCovered(window.Acknowledged, out _))
                {
                }
            }

            while (sent.TryTakeLost(now, trip, out SentDatagrams.Datagram lost))
            {
                Lose(lost);
            }

            while (sent.TryPeekOldest(out SimTime at) && now - at > trip * 5 && sent.TryTakeOldest(out SentDatagrams.Datagram overdue))
            {
                Lose(overdue);
            }
        }

        return received == entries.Last;

        void Lose(SentDatagrams.Datagram? datagram)
        {
            if (datagram is not SentDatagrams.Datagram its || (fault == Fault.ForgetsLosses && random.Next(10) == 0))
            {
                return;
            }

            sent.NoteLost(its);
            window.Lose(its.First, its.Last, isOnItsWay: sent.IsCarriedLater(its, its.First, its.Last));
        }
    }

    private sealed class Entries : IEntrySource
    {
        public uint Last { get; set; }

        public UpdateEntry this[uint number] => new(Verdict.Accepted, number);
    }
}
