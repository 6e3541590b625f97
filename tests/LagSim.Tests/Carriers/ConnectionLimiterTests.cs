using System.Collections.Generic;
using System.Linq;
using System.Net;
using LagSim.Net.Carriers;
using LagSim.Tests.Clocks;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Carriers;

/// <summary>Who gives way to whom where there are fewer places than connections.</summary>
public sealed class ConnectionLimiterTests
{
    private static readonly SimDuration Safe = SimDuration.FromSeconds(10);

    private readonly ManualClock clock = new();
    private readonly List<string> ended = [];
    private readonly ConnectionLimiter limiter;

    public ConnectionLimiterTests() => limiter = new ConnectionLimiter(8, clock);

    [Fact]
    public void Machine_WithHalfOfThePlaces_HasNoOtherUntilOneOfItsOwnIsNotSafe()
    {
        Enter("192.0.2.1", 4, out _);
        Assert.Null(Enter("192.0.2.1"));
        Assert.False(limiter.HasRoom(Machine("192.0.2.1")));
        Assert.NotNull(Enter("192.0.2.2"));
        clock.Now += Safe;
        Assert.Null(Enter("192.0.2.1"));
        clock.Now += SimDuration.OneTick;
        Assert.NotNull(Enter("192.0.2.1"));
        Assert.Equal(["192.0.2.1"], ended);
        Assert.Equal(5, limiter.Taken);
    }

    /// <summary>Who has all 64 bits of an IPv6 network is one machine.</summary>
    [Fact]
    public void Network_Of64Bits_IsOneMachine()
    {
        for (int n = 0; n < 4; n++)
        {
            Assert.NotNull(Enter($"2001:db8::{n}"));
        }

        Assert.Null(Enter("2001:db8::ffff:1:1"));
        Assert.NotNull(Enter("2001:db8:0:1::1"));
    }

    /// <summary>Two machines that hold the door shut, the one thing that a limit for each machine does not help against.</summary>
    [Fact]
    public void Machines_WithManyEach_GiveWayAtOnceToOneWithFewer()
    {
        Enter("192.0.2.1", 4, out _);
        clock.Now += SimDuration.FromSeconds(1);
        Enter("192.0.2.2", 4, out _);
        Assert.NotNull(Enter("192.0.2.3"));
        Assert.NotNull(Enter("192.0.2.3"));
        Assert.Equal(["192.0.2.1", "192.0.2.2"], ended); // of the one with the most; of two, the one that came first
        Assert.Null(Enter("192.0.2.3")); // it would have as many as they have
        Assert.Equal(8, limiter.Taken);
    }

    /// <summary>However often they come again, and however long the other has been there.</summary>
    [Fact]
    public void Machines_WithManyEach_TakeNothingFromOneWithFewer()
    {
        ConnectionPlace few = Enter("192.0.2.3")!;
        Enter("192.0.2.1", 4, out _);
        Enter("192.0.2.2", 3, out _);
        for (int n = 0; n < 40; n++)
        {
            clock.Now += Safe;
            Enter($"192.0.2.{1 + (n % 2)}");
        }

        Assert.True(ended.Count > 30);
        Assert.DoesNotContain("192.0.2.3", ended);
        few.Dispose();
        Assert.Equal(7, limiter.Taken);
    }

    [Fact]
    public void Place_ThatIsHeld_GivesWayToNobody()
    {
        Enter("192.0.2.1", 4, out ConnectionPlace[] first);
        Enter("192.0.2.2", 4, out ConnectionPlace[] second);
        foreach (ConnectionPlace place in first.Concat(second))
        {
            place.Hold(Safe);
        }

        Assert.Null(Enter("192.0.2.3"));
        clock.Now += SimDuration.FromSeconds(5);
        first[0].Hold();
        second[3].Hold(Safe);
        clock.Now += SimDuration.FromSeconds(6);
        for (int n = 3; n < 50; n++)
        {
            Enter($"192.0.2.{n}");
        }

        Assert.Equal(["192.0.2.1", "192.0.2.1", "192.0.2.1", "192.0.2.2", "192.0.2.2", "192.0.2.2"], ended.Order());
        Assert.True(first[0].IsHeld(clock.Now + SimDuration.FromSeconds(1e6)));
    }

    /// <summary>A crowd behind one address has its half, whatever others do, as far as it is held.</summary>
    [Fact]
    public void Crowd_OfOneAddress_KeepsItsHalf()
    {
        Enter("192.0.2.1", 4, out ConnectionPlace[] crowd);
        foreach (ConnectionPlace place in crowd)
        {
            place.Hold();
        }

        for (int n = 2; n < 50; n++)
        {
            clock.Now += Safe;
            Enter($"192.0.2.{n}");
        }

        Assert.DoesNotContain("192.0.2.1", ended);
        Assert.Equal((8, 44), (limiter.Taken, ended.Count)); // of 48, four are there
    }

    [Fact]
    public void Place_ThatIsGivenBack_IsFreeOnce()
    {
        Enter("192.0.2.1", 4, out ConnectionPlace[] all);
        all[1].Dispose();
        all[1].Dispose();
        Assert.Equal(3, limiter.Taken);
        Assert.NotNull(Enter("192.0.2.1"));
        Assert.Null(Enter("192.0.2.1"));
        Assert.Empty(ended);
    }

    private static PeerAddress Machine(string address) => PeerAddress.From(new IPEndPoint(IPAddress.Parse(address), 80));

    private ConnectionPlace? Enter(string address) => limiter.TryEnter(Machine(address), Safe, () => ended.Add(address));

    private void Enter(string address, int count, out ConnectionPlace[] places) => places = [.. Enumerable.Range(0, count).Select(_ => Enter(address)!)];
}
