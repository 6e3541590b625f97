using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>
/// Keys have an age at each end of a link: the host gives up a link without fresh keys for an hour, whatever its client does; and a machine that
/// slept gives up none for the time that it slept.
/// </summary>
public sealed class KeyAgeTests : IDisposable
{
    private const int GenerationAt = 17;
    private const int ExchangeLength = WireFormat.KeyExchangeBytes + WireFormat.SealBytes;
    private const string NoFreshKeys = "The host agreed on no fresh keys for 3600 s.";

    private readonly HostIdentity identity = HostIdentity.Draw();
    private readonly PathAttacker attacker = new();
    private readonly List<string> why = [];
    private int gone;

    public void Dispose() => identity.Dispose();

    /// <summary>
    /// Somebody on the path drops all exchanges, and the client's machine sleeps a little after 45 minutes, by which its own keys count as a
    /// quarter of an hour old. The host ends the link after an hour all the same. The control: if the host's machine slept too, neither end
    /// does before 45 minutes more are over, so it is the age of the host's keys that ended it.
    /// </summary>
    [Theory]
    [InlineData(false, 3600)]
    [InlineData(true, 5400)]
    public void Host_OfALinkWithoutFreshKeys_EndsItAfterAnHour(bool sleepsToo, double expected)
    {
        SessionGroup group = Playing();
        attacker.Drops = (_, bytes) => IsExchange(bytes);
        group.Run(2700);
        Sleep(group, 8, sleepsToo ? [0, 1] : [1]);
        Assert.Equal((0, 0), (gone, why.Count));
        group.Run(expected - 2708 - 20);
        Assert.Equal((0, 0), (gone, why.Count));
        group.Run(40);
        Assert.Equal([NoFreshKeys], why);
        Assert.Equal(1, gone);
        Assert.Equal((SessionState.Running, 1, 1, 1L), (group.Client(1).State, group.Host.ClientCount, group.Client(1).Peer, group.Client(1).Counters.Renewals));
        Assert.Null(group.Difference());
    }

    /// <summary>
    /// The machine on which all peers run sleeps for two hours. Their links go on, and get fresh keys at once. The control: where exchanges
    /// are dropped then, 45 minutes later they end, so sleeping is no way around the hour.
    /// </summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Link_OfMachinesThatSlept_GoesOnWithFreshKeys(bool isBlocked)
    {
        SessionGroup group = Playing();
        attacker.Drops = (_, bytes) => isBlocked && IsExchange(bytes);
        group.Run(60);
        Sleep(group, 7200, [0, 1]);
        group.Run(5);
        Assert.Equal((0, 0), (gone, why.Count));
        Assert.Equal(isBlocked ? [0] : [0, 1], Generations(0));
        Assert.Equal(isBlocked ? [0] : [0, 1], Generations(1));
        group.Run(2680);
        Assert.Equal((0, 0), (gone, why.Count));
        group.Run(40);
        Assert.Equal(isBlocked ? [NoFreshKeys] : [], why);
        Assert.Equal(isBlocked ? 1L : 0L, group.Client(1).Counters.Renewals);
        Assert.Equal(0, group.Client(1).Counters.StatesDiffered);
        Assert.Null(group.Difference());
    }

    private static bool IsExchange(byte[] bytes) => bytes[3] == PathAttacker.Sealed && bytes.Length == ExchangeLength;

    /// <summary>Lets time pass in which some machines do nothing, and their clocks go on.</summary>
    private static void Sleep(SessionGroup group, double seconds, int[] asleep)
    {
        Array.ForEach(asleep, group.Steps.Freeze);
        group.Run(seconds);
        Array.ForEach(asleep, group.Steps.Thaw);
        group.Run(1);
    }

    private SessionGroup Playing()
    {
        SecureHost host = new(identity);
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, wrap: attacker.Wrap, options: peer => peer == 0
            ? new HostOptions { Protection = host }
            : new ClientOptions { Protection = new SecureClient(identity.Fingerprint) });
        group.Connect();
        group.Client(1).Interrupted += why.Add;
        group.Host.ClientGone += _ => gone++;
        return group;
    }

    /// <summary>The generations of what a peer sealed, in the order in which they came.</summary>
    private int[] Generations(int peer) =>
        [.. attacker.Heard.Where(h => h.From == peer && h.Bytes[3] == PathAttacker.Sealed).Select(h => (int)h.Bytes[GenerationAt]).Distinct()];
}
