using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Clocks;
using LagSim.Net.Display;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Api;

/// <summary>No error shows a time with its up to forty decimals, and each shows the one that was given.</summary>
public sealed class ReadableMessagesTests
{
    private static readonly Dictionary<string, (Action Act, string Word)> Wrong = new()
    {
        ["read too far"] = (() => new Simulation(Drop(1, 1)).StateHash(At(77.7)), "77.7s"),
        ["advance back"] = (() => Run(Drop(1, 1), 0.3).AdvanceTo(At(0.1)), "0.1s"),
        ["snapshot ahead"] = (() => Run(Drop(1, 1), 0.3).Snapshot(At(0.7)), "0.7s"),
        ["arrival"] = (() => Run(Drop(1, 1), 0.1).SubmitForwarded(ExternalEvent.Remove(At(0.3), 1, 1, First), At(0.2)), "0.2s"),
        ["history"] = (() => _ = new SimulationOptions(history: Span(-0.1)), "-0.1s"),
        ["start"] = (() => _ = new SimulationOptions(At(7e6) + Span(0.1)), "7000000.1s"),
        ["window history"] = (() => _ = new LatencyCompensationWindow(Span(0.001)), "0.001s"),
        ["window look-ahead"] = (() => _ = new LatencyCompensationWindow(Span(1), Span(7.3)), "7.3s"),
        ["window lag"] = (() => new LatencyCompensationWindow(Span(1), Span(0.1)).WithLocalLag(EventKind.Impulse, Span(0.3)), "0.3s"),
        ["live look-ahead"] = (() => _ = new LiveWorld(Drop(1, 1), new SimulationOptions(history: Span(1)), Span(1.1)), "1.1s"),
        ["live picture"] = (() => _ = new LiveWorld(Drop(1, 1), new SimulationOptions(history: Span(1)), renderedPast: Span(-0.1)), "-0.1s"),
        ["live history"] = (() => _ = new LiveWorld(Drop(1, 1), new SimulationOptions(history: Span(0.01)), Span(0.1)), "0.01s"),
        ["committed"] = (() => Commit(0.7, 0.3), "0.3s"),
        ["span of display"] = (() => _ = new DisplayOptions(fastest: Span(0.3), slowest: Span(0.2)), "0.2s"),
        ["delay of a hand"] = (() => AdaptivePredictor.ErrorLowerBound(1, Span(-0.1)), "-0.1s"),
        ["option of a session"] = (() => new HostOptions { CommitInterval = Span(0.01) }.Check(), "0.01s"),
        ["knot"] = (() => Sample(0.7, 0.3), "0.3s"),
        ["longest without a knot"] = (() => _ = new HandSender(First, new HandSenderOptions { Longest = Span(7.1) }), "7.1s"),
        ["between two knots"] = (() => _ = new HandSender(First, new HandSenderOptions { Longest = Span(0.1), Shortest = Span(0.3) }), "0.3s"),
        ["display delay"] = (() => _ = new Interpolation(Span(7.1)), "7.1s"),
        ["offset of clocks"] = (() => new SharedClock(new VirtualClock()).Adjust(Span(7e6) + Span(0.1)), "7000000.1s"),
        ["virtual clock"] = (() => _ = new VirtualClock { Now = At(-0.1) }, "-0.1s"),
        ["datagram"] = (() => Send(0.7, 0.3), "0.3s"),
    };

    public static TheoryData<string> Cases => [.. Wrong.Keys];

    [Theory]
    [MemberData(nameof(Cases))]
    public void Message_OfATimeOutOfItsRange_IsShortAndNamesIt(string what)
    {
        (Action act, string word) = Wrong[what];
        string message = Assert.Throws<ArgumentOutOfRangeException>(act).Message;
        Assert.Contains($"Actual value was {word}.", message, StringComparison.Ordinal);
        Assert.False(IsLong(message), message);
    }

    [Fact]
    public void IsLong_OfTheExactText_IsTrue() => Assert.True(IsLong($"Actual value was {Span(0.1)}."));

    private static bool IsLong(string message) => Regex.IsMatch(message, "[0-9]{14}");

    private static SimDuration Span(double seconds) => SimDuration.FromSeconds(seconds);

    private static void Commit(params double[] seconds)
    {
        using RecordingWriter writer = new(new MemoryStream(), 0, Drop(1, 1), default);
        foreach (double time in seconds)
        {
            writer.WriteCommitted(At(time), 1, 2);
        }
    }

    private static void Sample(params double[] seconds)
    {
        HandSender sender = new(First);
        foreach (double time in seconds)
        {
            sender.TrySample(At(time), V(0), V(0), out _);
        }
    }

    private static void Send(params double[] seconds)
    {
        LinkModel link = new(LinkProfiles.Lan.ToHost, new SeededRandom(1));
        seconds.Select(At).ToList().ForEach(time => link.Send(time, 100));
    }
}
