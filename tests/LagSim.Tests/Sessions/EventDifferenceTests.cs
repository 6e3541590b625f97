using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Clients;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>The first event in which the accounts of two peers differ.</summary>
public sealed class EventDifferenceTests
{
    [Fact]
    public void First_OfEqualAccounts_IsNone() => Assert.True(First([Entry(1), Entry(2)], [Entry(1), Entry(2)]).IsNone);

    [Fact]
    public void First_OneThatIsMissingHere_IsTheHosts()
    {
        EventDifference first = First([Entry(1), Entry(2), Entry(3)], [Entry(1), Entry(3)]);
        Assert.Equal((Entry(2), null, false), (first.Hosts!.Value, first.Own, first.HasOwnEffect));
    }

    [Fact]
    public void First_OneThatIsMissingThere_IsOwn()
    {
        EventDifference first = First([Entry(1), Entry(3)], [Entry(1), Entry(2), Entry(3)]);
        Assert.Equal((null, Entry(2), true), (first.Hosts, first.Own!.Value, first.HasOwnEffect));
    }

    [Fact]
    public void First_OneThatIsAnother_HasBothVersions()
    {
        EventDifference first = First([Entry(1), Entry(2, speed: 5)], [Entry(1), Entry(2)]);
        Assert.Equal((Entry(2, speed: 5), Entry(2), true), (first.Hosts!.Value, first.Own!.Value, first.HasOwnEffect));
    }

    private static LogEntry Entry(uint number, double speed = 1) => new(
        number,
        Verdict.Accepted,
        PlayerAction.SetVelocity(BodyId.OfScene(0), new Vector3D(speed, 0, 0)).Stamp(SimTime.FromSeconds(number), 1, number));

    private static EventDifference First(LogEntry[] theirs, LogEntry[] own)
    {
        RecentEvents recent = new();
        foreach (LogEntry entry in own)
        {
            recent.Add(entry, hasEffect: true);
        }

        return EventDifference.First([.. theirs], [.. own], recent);
    }
}
