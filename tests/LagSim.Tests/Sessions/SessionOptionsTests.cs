using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using LagSim.Corpus;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>
/// What hosts and clients are told: each has its own settings, both have those of every peer, and what is not allowed is refused by name.
/// </summary>
public sealed class SessionOptionsTests
{
    private static readonly string[] OfHosts =
        ["ConfirmsEarly", "ExpectedClients", "LongestHistory", "MaxBytesPerSecond", "MaxClientsPerAddress", "MaxEventsPerSecond", "PlayerBudget", "PlayerKeys", "Protection", "SpectatorPlaces", "StartLead", "Unprotected"];

    private static readonly string[] OfClients = ["Accelerations", "Pass", "Protection", "Rules", "Token"];

    private static readonly SimDuration Long = SimDuration.FromSeconds(10_000);

    private static readonly ClientOptions Changed = new()
    {
        Name = "Ann",
        Role = PeerRole.Bot,
        ConnectKey = "secret",
        RejoinTime = SimDuration.FromSeconds(3),
        MaxGivenSpeed = 5,
        MaxHandForce = 7,
        MaxHandPower = 8,
        MaxSpawned = 6,
        CommitInterval = SimDuration.FromSeconds(2),
        Window = new LatencyCompensationWindow(SimDuration.FromSeconds(3)),
        MaxSegments = 1000,
        ExtraHistory = SimDuration.FromSeconds(4),
        RenderedPast = SimDuration.FromSeconds(5),
        Timeout = SimDuration.FromSeconds(6),
        ResendInterval = SimDuration.FromMilliseconds(40),
        KeepAlive = SimDuration.FromSeconds(1),
        Contacts = new ContactNotices(),
        Crossings = new CrossingNotices(),
        Losses = new LossNotices(),
        RuleNotices = new RuleNotices(),
        RuleTimeout = SimDuration.FromSeconds(7),
        Strategy = LateEventStrategy.Interpolation,
        SyncTest = true,
        DisplayDelay = SimDuration.FromMilliseconds(70),
        Warmup = false,
        Cancellation = new(canceled: true),
    };

    public static TheoryData<string> Wrong => new(WrongOnes.Keys);

    private static Dictionary<string, SessionOptions> WrongOnes { get; } = new()
    {
        ["Accelerations"] = new ClientOptions { Accelerations = [null!] },
        ["CommitInterval"] = new ClientOptions { CommitInterval = Long },
        ["ConnectKey"] = new ClientOptions { ConnectKey = new string('x', 257) },
        ["DisplayDelay"] = new ClientOptions { DisplayDelay = Long },
        ["ExpectedClients"] = new HostOptions { ExpectedClients = 17 },
        ["ExtraHistory"] = new ClientOptions { ExtraHistory = Long },
        ["KeepAlive"] = new ClientOptions { KeepAlive = Long },
        ["MaxClientsPerAddress"] = new HostOptions { MaxClientsPerAddress = 0 },
        ["MaxEventsPerSecond"] = new HostOptions { MaxEventsPerSecond = 0 },
        ["MaxGivenSpeed"] = new HostOptions { MaxGivenSpeed = double.NaN },
        ["MaxHandForce"] = new HostOptions { MaxHandForce = -1 },
        ["MaxHandPower"] = new ClientOptions { MaxHandPower = double.NaN },
        ["MaxSegments"] = new ClientOptions { MaxSegments = 0 },
        ["MaxSpawned"] = new ClientOptions { MaxSpawned = -1 },
        ["Name"] = new ClientOptions { Name = "a\nb" },
        ["PlayerKeys"] = new HostOptions { PlayerKeys = new Dictionary<byte, string> { [17] = "seventeen" } },
        ["RejoinTime"] = new ClientOptions { RejoinTime = Long },
        ["RenderedPast"] = new ClientOptions { RenderedPast = Long },
        ["ResendInterval"] = new ClientOptions { ResendInterval = Long },
        ["Role"] = new ClientOptions { Role = 0 },
        ["RuleTimeout"] = new ClientOptions { RuleTimeout = Long },
        ["Rules"] = new ClientOptions { Rules = [null!] },
        ["SpectatorPlaces"] = new HostOptions { SpectatorPlaces = 33 },
        ["StartLead"] = new HostOptions { StartLead = Long },
        ["Timeout"] = new ClientOptions { Timeout = Long },
        ["Window"] = new ClientOptions { Window = null! },
    };

    private static PropertyInfo[] Common => typeof(SessionOptions).GetProperties(BindingFlags.Public | BindingFlags.Instance);

    [Fact]
    public void Host_AndClient_ShowOnlyTheirOwn()
    {
        Assert.Equal(OfHosts, Own(typeof(HostOptions)));
        Assert.Equal(OfClients, Own(typeof(ClientOptions)));
    }

    [Fact]
    public void From_TheOtherSide_TakesEverySettingThatBothHave()
    {
        HostOptions host = HostOptions.From(Changed);
        ClientOptions back = ClientOptions.From(host);
        HostOptions defaults = new();
        Assert.All(Common, setting => Assert.NotEqual(setting.GetValue(defaults), setting.GetValue(Changed))); // the control
        Assert.All(Common, setting => Assert.Equal(setting.GetValue(Changed), setting.GetValue(host)));
        Assert.Equal(Changed, back);
        Assert.Same(host, HostOptions.From(host));
        Assert.Throws<ArgumentNullException>(() => HostOptions.From(null!));
        Assert.Throws<ArgumentNullException>(() => ClientOptions.From(null!));
    }

    [Fact]
    public void ToString_TellsNoSecret() => Assert.Equal(("ClientOptions", "HostOptions"), ($"{Changed}", $"{HostOptions.From(Changed)}"));

    [Theory]
    [MemberData(nameof(Wrong))]
    public void Session_WithWhatIsNotAllowed_IsRefusedByName(string named)
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        SessionOptions wrong = WrongOnes[named];
        ArgumentException refused = Assert.ThrowsAny<ArgumentException>(() => _ = wrong is HostOptions host
            ? (Session)new HostSession(ScriptedActions.Box(), port, new VirtualClock(), host, 1)
            : new ClientSession(null, port, new VirtualClock(), (ClientOptions)wrong, PeerAddress.Virtual(1), 1));
        Assert.Equal(named, refused.ParamName);
        Assert.EndsWith(".", refused.Message.Split(" (Parameter")[0], StringComparison.Ordinal);
    }

    [Fact]
    public void Collections_ChangedAfterwards_LeaveTheOptionsAsTheyWere()
    {
        Dictionary<byte, string> keys = new() { [1] = "one" };
        List<IAcceleration> supplied = [new Eddy()];
        HostOptions host = new() { PlayerKeys = keys };
        ClientOptions client = new() { Accelerations = supplied };
        keys[2] = "two";
        supplied.Clear();
        Assert.Equal(("one", 1), (host.PlayerKeys[1], host.PlayerKeys.Count));
        Assert.Single(client.Accelerations);
    }

    [Fact]
    public void Refusals_OfKeys_DoNotTellThem()
    {
        const string Secret = "swordfish";
        string tooLong = string.Concat(Enumerable.Repeat(Secret, 40));
        HostOptions[] wrong =
        [
            new() { ConnectKey = tooLong },
            new() { PlayerKeys = new Dictionary<byte, string> { [1] = tooLong } },
            new() { ConnectKey = Secret, PlayerKeys = new Dictionary<byte, string> { [1] = Secret } },
            new() { PlayerKeys = new Dictionary<byte, string> { [1] = Secret, [2] = Secret } },
            new() { PlayerKeys = new Dictionary<byte, string> { [0] = Secret } },
        ];
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        foreach (HostOptions options in wrong)
        {
            ArgumentException refused = Assert.ThrowsAny<ArgumentException>(() =>
                _ = new HostSession(ScriptedActions.Box(), port, new VirtualClock(), options, 1));
            Assert.DoesNotContain(Secret, $"{refused}", StringComparison.Ordinal);
            Assert.Contains("key", refused.Message, StringComparison.Ordinal); // the control: it is about keys
        }
    }

    [Fact]
    public void Session_WithADurationOutOfRange_ShowsItAndTheLimitsInFull()
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        HostOptions options = new() { Timeout = SimDuration.FromMilliseconds(100), KeepAlive = SimDuration.FromSeconds(1) };
        ArgumentException refused = Assert.ThrowsAny<ArgumentException>(() =>
            _ = new HostSession(ScriptedActions.Box(), port, new VirtualClock(), options, 1));
        Assert.Contains("between 10 ms and a third of the timeout of 0.1s", refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Session_WithWhatIsAllowed_IsNotRefused()
    {
        using IDatagramPort port = new VirtualNetwork(new VirtualClock(), 1).CreatePort(0);
        HostOptions options = HostOptions.From(Changed) with { Cancellation = default };
        HostSession host = new(ScriptedActions.Box(), port, new VirtualClock(), options, 1);
        Assert.Equal(SessionState.Waiting, host.State);
    }

    private static string[] Own(Type type) =>
        [.. type.GetProperties(BindingFlags.Public | BindingFlags.Instance | BindingFlags.DeclaredOnly)
            .Select(p => p.Name).Order(StringComparer.Ordinal)];
}
