using System;
using LagSim.Net.Sessions.Links;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>In how many updates in a row an entry goes follows from what the link loses, singly or in runs, not from how long it is.</summary>
public sealed class LossRunsTests
{
    private const int NearBy = 3, Far = 32; // updates that wait for a lost one

    [Fact]
    public void Copies_WithoutLosses_IsOne_HoweverLongTheLink()
    {
        LossRuns runs = Measured(0, 1, 3000);
        Assert.Equal(1, runs.Copies(NearBy));
        Assert.Equal(1, runs.Copies(Far));
    }

    [Fact]
    public void Copies_OfANewLink_AreAsManyAsCanBe()
    {
        LossRuns runs = new();
        Assert.Equal(LossRuns.MaxCopies, runs.Copies(NearBy));
        Assert.InRange(Measured(0, 1, 200).Copies(NearBy), 1, 2);
    }

    [Theory]
    [InlineData(0.01, NearBy, 2, 2)]
    [InlineData(0.02, NearBy, 2, 2)]
    [InlineData(0.01, Far, 2, 3)]
    [InlineData(0.02, Far, 2, 4)]
    public void Copies_WhereSingleOnesAreLost_AreFew(double loss, int blocked, int least, int most) =>
        Assert.InRange(Measured(loss, 1, 5000).Copies(blocked), least, most);

    [Fact]
    public void Copies_WhereRunsAreLost_AreMoreThanWhereSingleOnesAre()
    {
        Assert.InRange(Measured(0.01, 3, 5000).Copies(NearBy), 4, 16);
        Assert.True(Measured(0.01, 3, 5000).Copies(NearBy) > Measured(0.01, 1, 5000).Copies(NearBy));
    }

    [Fact]
    public void Copies_OfABadLink_AreAsManyAsCanBe_UntilItIsBetter()
    {
        Random random = new(1);
        LossRuns runs = new();
        uint number = 0;
        Feed(runs, ref number, random, 0.2, 5, 2000);
        Assert.True(runs.IsBad);
        Assert.Equal(LossRuns.MaxCopies, runs.Copies(1));
        Feed(runs, ref number, random, 0, 1, 5000);
        Assert.False(runs.IsBad);
        Assert.Equal(1, runs.Copies(NearBy));
    }

    /// <summary>Answers that are lost, or come out of order, hide nothing and count nothing twice.</summary>
    [Fact]
    public void Note_OfSeldomAnswers_FindsTheSame()
    {
        LossRuns each = new(), some = new();
        Random random = new(3);
        uint bits = 0;
        for (uint number = 1; number < 4000; number++)
        {
            bool came = random.NextDouble() > 0.015;
            if (came)
            {
                each.Note(number, bits);
                if (random.Next(8) == 0)
                {
                    some.Note(number, bits);
                    some.Note(number, bits);
                }
            }

            bits = (bits << 1) | (came ? 1u : 0);
        }

        Assert.Equal(each.Copies(Far), some.Copies(Far));
    }

    private static LossRuns Measured(double loss, double run, int count)
    {
        LossRuns runs = new();
        uint number = 0;
        Feed(runs, ref number, new Random(2), loss, run, count);
        return runs;
    }

    /// <summary>Updates of which a share is lost, in runs of a mean length, all that arrive answered.</summary>
    private static void Feed(LossRuns runs, ref uint number, Random random, double loss, double run, int count)
    {
        double stays = run == 1 ? loss : 1 - (1 / run);
        double begins = loss == 0 ? 0 : loss * (1 - stays) / (1 - loss);
        bool isLost = false;
        uint bits = uint.MaxValue;
        for (int n = 0; n < count; n++)
        {
            isLost = random.NextDouble() < (isLost ? stays : begins);
            number++;
            if (!isLost)
            {
                runs.Note(number, bits);
            }

            bits = (bits << 1) | (isLost ? 0 : 1u);
        }
    }
}
