using System;

namespace LagSim.Net.Sessions.Links;

/// <summary>Measures how often a link loses datagrams, and how many in a row; from that follows in how many datagrams an entry goes.</summary>
/// <remarks>
/// <para>It judges updates by number, in order, once three later ones have arrived or may have (RFC 9002, 6.1.1). What comes later than that
/// counts as lost: entries wait for it too.</para>
/// <para>Losses are taken to come in runs whose lengths are geometric, as by Gilbert and Elliott: a share of all datagrams, and a larger share
/// of those after a lost one. So an entry in n updates in a row is lost with all of them in the first share times the second to the power
/// of n - 1. A long run cannot be measured otherwise: what happens once in ten thousand datagrams is not seen in time.</para>
/// </remarks>
internal sealed class LossRuns
{
    /// <summary>The most updates in a row that an entry goes in before any is known to be lost.</summary>
    internal const int MaxCopies = 32;

    /// <summary>
    /// The share of entries that may come late because all copies of one were lost, on each of the two links on an event's way: together less
    /// than a hundredth, so that the 99th percentile of lateness is that of a link without losses.
    /// </summary>
    private const double Bearable = 0.004;

    /// <summary>How many later updates show that one is lost.</summary>
    private const uint Overtaken = 3;

    /// <summary>How many updates the share is measured over, and how many stand for those before the first.</summary>
    private const int Memory = 512, FirstCounted = 64;

    /// <summary>After how many updates a link is known: it may be one that loses several datagrams in a row, and seldom.</summary>
    private const int Many = 128;

    /// <summary>The share above which a link is bad: there no length of runs is measured well enough.</summary>
    private const double Heavy = 0.05;

    /// <summary>The share of a new link: little, but where a loss costs much enough for a second copy until some hundred updates have arrived.</summary>
    private const double FirstShare = 0.0005;

    /// <summary>What stands for earlier losses on a new link, and the number of losses after which older ones count half.</summary>
    private const double FirstAfterLost = 1, FirstTwice = 0.1, MaxAfterLost = 64;

    private double share = FirstShare;
    private int counted = FirstCounted;
    private double afterLost = FirstAfterLost; // how many updates followed a lost one
    private double twice = FirstTwice; // how many of them were lost too
    private uint judged;
    private bool wasLost;

    /// <summary>Whether so much is lost that entries go again as often as possible until they have come.</summary>
    internal bool IsBad => share > Heavy;

    /// <summary>Takes in which updates have arrived at the other end.</summary>
    /// <param name="newest">The number of the newest.</param>
    /// <param name="before">Which of the 32 before it arrived; the lowest bit is the one just before.</param>
    internal void Note(uint newest, uint before)
    {
        for (judged = Math.Max(judged, newest > 33 ? newest - 33 : 0); judged + Overtaken < newest; judged++)
        {
            Judge((before >> (int)(newest - judged - 2) & 1) == 0); // the one after the last that was judged
        }
    }

    /// <summary>Returns in how many updates in a row an entry goes, from 1; as often as possible while the link is not known, or bad.</summary>
    /// <param name="blocked">How many updates wait, until all copies of an entry are known to be lost and it has come again.</param>
    internal int Copies(double blocked)
    {
        if (counted < FirstCounted + Many || IsBad)
        {
            return MaxCopies;
        }

        double next = Math.Min(1, (twice + (Math.Sqrt(Math.Max(0, twice - 1)) / 2)) / afterLost); // at worst, as far as so few tell
        double lost = share * blocked;
        int copies = 1;
        for (; copies < MaxCopies && lost > Bearable; copies++)
        {
            lost *= next;
        }

        return copies;
    }

    private void Judge(bool isLost)
    {
        counted = Math.Min(counted + 1, Memory);
        share += ((isLost ? 1 : 0) - share) / counted;
        if (wasLost)
        {
            afterLost++;
            twice += isLost ? 1 : 0;
            if (afterLost > MaxAfterLost)
            {
                (afterLost, twice) = (afterLost / 2, twice / 2);
            }
        }

        wasLost = isLost;
    }
}
