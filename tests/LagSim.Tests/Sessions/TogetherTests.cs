using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>
/// Players who steer all the time: events travel together, and go again for losses, not for distance.
/// </summary>
public sealed class TogetherTests(ITestOutputHelper output)
{
    private const int Clients = 3;
    private const double Rate = 30, Seconds = 12;

    /// <summary>The bytes that a client's share of events needs a second, with the headers of a datagram for three of them.</summary>
    private const double Needed = (Clients * Rate * (47 + Headers)) + (Rate * (5 + Headers));
    private const double Headers = (59 + 16 + 28) / 3.0;

    [Theory]
    [InlineData(5, 0)]
    [InlineData(100, 0)]
    [InlineData(250, 0)]
    [InlineData(5, 2)]
    [InlineData(50, 1)]
    [InlineData(100, 2)]
    [InlineData(250, 1)]
    public void Steering_TakesAtMostTwiceWhatTheEventsNeed_AndSixtyDatagramsASecond(double delay, double loss)
    {
        Played played = Play(delay, loss, Rate);
        output.WriteLine($"{played}, {played.DownBytes / Needed:0.00} times what is needed");
        Assert.InRange(played.DownBytes / Needed, 1, 2);
        Assert.InRange(played.DownDatagrams, 30, 61);
        Assert.InRange(played.UpDatagrams, 25, 61);
        Assert.InRange(played.Median - (2 * delay), 0, 9); // two halves of a sixtieth of a second at the most, less where little goes
        Assert.Equal(0, played.Refused);
    }

    /// <summary>What is measured grows where entries go again until they have come, as far as they are known: on a bad link.</summary>
    [Fact]
    public void Steering_OnABadLink_TakesMoreThanTwice()
    {
        Played played = Play(100, 12, Rate);
        output.WriteLine($"{played}, {played.DownBytes / Needed:0.00} times what is needed");
        Assert.True(played.DownBytes > 2 * Needed);
    }

    /// <summary>
    /// A cap on what each client is sent holds, and nothing is lost by it: repeats are given up first, then events wait for each other.
    /// </summary>
    [Theory]
    [InlineData(0, 8_000)]
    [InlineData(2, 8_000)]
    [InlineData(2, 12_000)]
    public void Steering_WithACap_KeepsToIt(double loss, int most)
    {
        Played free = Play(50, loss, Rate), capped = Play(50, loss, Rate, most);
        output.WriteLine($"{free}; capped {capped}");
        Assert.True(free.DownBytes > most, "it caps nothing");
        Assert.InRange(capped.DownBytes, 0.5 * most, 1.02 * most);
        Assert.Equal(0, capped.Refused);
        Assert.InRange(capped.Median, 100, 250);
    }

    [Theory]
    [InlineData(3_999)]
    [InlineData(100_000_001)]
    public void MaxBytesPerSecond_OutOfRange_IsRefused(int most)
    {
        ArgumentOutOfRangeException refusal = Assert.Throws<ArgumentOutOfRangeException>(() => Play(5, 0, Rate, most));
        Assert.Contains("4,000 to 100,000,000", refusal.Message, StringComparison.Ordinal);
    }

    /// <summary>A lone event does not wait for others.</summary>
    [Fact]
    public void ALoneEvent_IsThereAtOnce()
    {
        Played played = Play(40, 0, 0.7);
        output.WriteLine($"{played}");
        Assert.InRange(played.Median, 79.9, 80.5);
    }

    private static Played Play(double delay, double loss, double rate, int? most = null)
    {
        LinkProfile link = new("steered", new LinkLeg(delay, lossPercent: loss, meanBurstLength: 1 / (1 - (loss / 100))));
        SceneBuilder scene = new SceneBuilder("ships").WithGravity(V(0));
        for (int n = 0; n <= Clients; n++)
        {
            scene.AddBody($"ship {n}", Ball(0.1), V(0, 100 * n));
        }

        SessionGroup group = new SessionGroup(scene.Build(), Clients + 1, link, 1, _ => new HostOptions { PlayerBudget = null, MaxBytesPerSecond = most, Window = new(SimDuration.FromSeconds(3)) }).Connect();
        List<double> late = [];
        Random random = new(1);
        double[] next = [.. Enumerable.Range(0, Clients + 1).Select(_ => random.NextDouble() / rate)];
        const double warmUp = 8; // the link is known by then
        (long Bytes, long Datagrams) down = default, up = default;
        for (double at = 0; at < warmUp + Seconds; at += 0.001)
        {
            if (down == default && at >= warmUp)
            {
                (down, up) = (Sum(group.Host.Links), Sum(group.Sessions.Skip(1).SelectMany(s => s.Links)));
                foreach (Session session in group.Sessions.Skip(1))
                {
                    session.Logged += entry =>
                    {
                        if (entry.Event.Peer != session.Peer)
                        {
                            late.Add((session.SharedTime.Now - entry.Event.Time).ToMilliseconds());
                        }
                    };
                }
            }

            for (int who = 0; who <= Clients; who++)
            {
                if (at >= next[who])
                {
                    next[who] += (0.9 + (0.2 * random.NextDouble())) / rate;
                    group.Do(who, PlayerAction.Impulse(BodyId.OfScene(who), V(random.NextDouble() - 0.5)));
                }
            }

            group.Run(0.001);
        }

        (long Bytes, long Datagrams) downEnd = Sum(group.Host.Links), upEnd = Sum(group.Sessions.Skip(1).SelectMany(s => s.Links));
        group.Run(3);
        Assert.All(group.Sessions, session => Assert.Equal(group.Host.LogLength, session.LogLength));
        Assert.Null(group.Difference());
        late.Sort();

        double each = Clients * Seconds;
        return new Played(
            (downEnd.Bytes - down.Bytes) / each, (downEnd.Datagrams - down.Datagrams) / each, (upEnd.Datagrams - up.Datagrams) / each,
            late[late.Count / 2], group.Host.Counters.EventsRefused);

        static (long Bytes, long Datagrams) Sum(IEnumerable<LinkTraffic> links) =>
            links.Aggregate((0L, 0L), (sum, link) => (sum.Item1 + link.BytesSent + (28 * link.DatagramsSent), sum.Item2 + link.DatagramsSent));
    }

    private sealed record Played(double DownBytes, double DownDatagrams, double UpDatagrams, double Median, long Refused);
}
