using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Hosts;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Which number a newcomer gets, and for whom one is kept, against the rule spelled out.</summary>
public sealed class PlayerPlacesTests
{
    private static readonly SimDuration Kept = SimDuration.FromSeconds(30);

    [Fact]
    public void AnyComingAndGoing_GivesTheLeastThatNobodyHad_ThenThatGivenUpFirst_ThenThatKeptLongest()
    {
        for (int seed = 0; seed < 50; seed++)
        {
            Random random = new(seed);
            byte keyed = (byte)random.Next(0, 9);
            Dictionary<byte, string> keys = keyed == 0 ? [] : new() { [keyed] = "key" };
            HostOptions options = new() { RejoinTime = Kept, PlayerKeys = keys, MaxClientsPerAddress = SessionOptions.MaxClients };
            SimTime now = SimTime.FromSeconds(100);
            PlayerPlaces places = new(options, now);
            Dictionary<byte, (SimTime At, bool IsKept)> left = []; // of those that somebody had and nobody has
            HashSet<byte> taken = [];
            for (int step = 0; step < 300; step++)
            {
                now += SimDuration.FromSeconds(random.NextDouble() * 4);
                IEnumerable<byte> numbers = Enumerable.Range(1, SessionOptions.MaxClients).Select(n => (byte)n);
                byte[] free = [.. numbers.Where(n => !taken.Contains(n) && n != keyed)];
                byte[] fresh = [.. free.Where(n => !left.ContainsKey(n))];
                byte[] givenUp = [.. free.Except(fresh).Where(n => !left[n].IsKept || now - left[n].At > Kept)];
                byte expected = fresh.Length > 0 ? fresh.Min() : (givenUp.Length > 0 ? givenUp : free).OrderBy(n => left[n].At).FirstOrDefault();
                Assert.Equal(expected, places.Free(now, 0, default));
                if (expected > 0 && random.Next(2) == 0)
                {
                    Token128? before = places[expected].Pass;
                    places[expected].Take(isSamePlayer: false, default);
                    Assert.True(places[expected].IsTaken && places[expected].Pass is not null && places[expected].Pass != before);
                    taken.Add(expected);
                }
                else if (taken.Count > 0)
                {
                    byte leaver = taken.ElementAt(random.Next(taken.Count));
                    bool isKept = random.Next(2) == 0;
                    Token128? pass = places[leaver].Pass;
                    places[leaver].Leave(isKept, (ulong)step, isKept ? LeaveReason.TimedOut : LeaveReason.Left, now);
                    Assert.Equal(isKept ? pass : null, places[leaver].Pass);
                    Assert.Equal(isKept ? LeaveReason.TimedOut : LeaveReason.Left, places.WhyGone((ulong)step));
                    taken.Remove(leaver);
                    left[leaver] = (now, isKept);
                }
            }

            Assert.Equal(LeaveReason.NotJoined, places.WhyGone(ulong.MaxValue));
        }
    }

    [Fact]
    public void Claimed_OnlyWithTheProofOfItsPass_OverThatNonceAndCookie()
    {
        PlayerPlaces places = new(new HostOptions(), SimTime.Zero);
        places[3].Take(isSamePlayer: false, default);
        Token128 pass = places[3].Pass!.Value, cookie = new(5, 6), other = new(pass.First ^ 1, pass.Second);
        Assert.Same(places[3], places.Claimed(Join(3, JoinCookies.Prove(pass, 7, cookie)), 0));
        Assert.Null(places.Claimed(Join(3, JoinCookies.Prove(other, 7, cookie)), 0));
        Assert.Null(places.Claimed(Join(3, JoinCookies.Prove(pass, 8, cookie)), 0)); // heard by somebody, and played again
        Assert.Null(places.Claimed(Join(3, JoinCookies.Prove(pass, 7, other)), 0));
        Assert.Null(places.Claimed(Join(3, default), 0));
        Assert.Null(places.Claimed(Join(4, JoinCookies.Prove(pass, 7, cookie)), 0)); // nobody has had that number
        Assert.Null(places.Claimed(Join(4, JoinCookies.Prove(default(Token128), 7, cookie)), 0));
        Assert.Null(places.Claimed(Join(0, JoinCookies.Prove(pass, 7, cookie)), 0));
        Assert.Null(places.Claimed(Join(255, JoinCookies.Prove(pass, 7, cookie)), 0));
        places[3].Leave(isKept: true, 1, LeaveReason.TimedOut, SimTime.Zero);
        Assert.Same(places[3], places.Claimed(Join(3, JoinCookies.Prove(pass, 7, cookie)), 0));
        places[3].Take(isSamePlayer: true, default);
        Assert.Equal(pass, places[3].Pass);
        places[3].Take(isSamePlayer: false, default);
        Assert.Null(places.Claimed(Join(3, JoinCookies.Prove(pass, 7, cookie)), 0));

        JoinDatagram Join(byte player, Token128 proof) => new(7, cookie, default, 0, 0, player, proof);
    }

    [Fact]
    public void Claimed_NumberWithAKey_OpensToNoPassAlone()
    {
        PlayerPlaces places = new(new HostOptions { PlayerKeys = new Dictionary<byte, string> { [3] = "three" } }, SimTime.Zero);
        places[3].Take(isSamePlayer: false, default);
        Token128 cookie = new(5, 6);
        JoinDatagram join = new(7, cookie, default, 0, 0, 3, JoinCookies.Prove(places[3].Pass!.Value, 7, cookie));
        Assert.Null(places.Claimed(join, 0)); // whoever heard the pass has not the key
        Assert.Null(places.Claimed(join, 4));
        Assert.Same(places[3], places.Claimed(join, 3));
    }

    [Fact]
    public void Free_NumberWithoutSequencesLeft_IsGivenToNobody()
    {
        PlayerPlaces places = new(new HostOptions(), SimTime.Zero);
        places[1].LastSequence = uint.MaxValue;
        Assert.Equal(2, places.Free(SimTime.Zero, 0, default));
    }

    /// <summary>Whoever comes again and again from one machine, each time as somebody else, uses up its own numbers, and not that of one who stands still meanwhile.</summary>
    [Theory]
    [InlineData(4, true)]
    [InlineData(SessionOptions.MaxClients, false)] // the limit taken away
    public void Free_OneMachineThatComesAgainAndAgain_TakesNobodyElsesNumber(int perAddress, bool isLeft)
    {
        HostOptions options = new() { RejoinTime = Kept, MaxClientsPerAddress = perAddress };
        SimTime now = SimTime.FromSeconds(100);
        PlayerPlaces places = new(options, now);
        PeerAddress honest = PeerAddress.Virtual(1).Machine, greedy = PeerAddress.Virtual(2).Machine;
        places[1].Take(isSamePlayer: false, honest);
        Token128? pass = places[1].Pass;
        places[1].Leave(isKept: true, 1, LeaveReason.TimedOut, now);
        for (int n = 0; n < 20; n++)
        {
            now += SimDuration.FromMilliseconds(20);
            byte number = places.Free(now, 0, greedy);
            places[number].Take(isSamePlayer: false, greedy);
            places[number].Leave(isKept: true, 2, LeaveReason.TimedOut, now);
        }

        Assert.Equal(isLeft, places[1].Pass == pass);
    }

    /// <summary>However many its machine has, a number with a key goes to nobody without it.</summary>
    [Fact]
    public void Free_NumberWithAKey_IsNotGivenToItsMachineEither()
    {
        PeerAddress machine = PeerAddress.Virtual(1).Machine;
        HostOptions options = new() { MaxClientsPerAddress = 1, RejoinTime = Kept, PlayerKeys = new Dictionary<byte, string> { [3] = "three" } };
        PlayerPlaces places = new(options, SimTime.Zero);
        places[3].Take(isSamePlayer: false, machine);
        places[3].Leave(isKept: true, 1, LeaveReason.TimedOut, SimTime.Zero);
        Assert.Equal(1, places.Free(SimTime.Zero, 0, machine));
    }
}
