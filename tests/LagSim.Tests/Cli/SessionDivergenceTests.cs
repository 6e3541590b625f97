using System;
using System.IO;
using System.Linq;
using System.Net;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Join over real sockets, through ports that change what the host says: what differs or is lost is a check that failed.</summary>
[Collection(RealTime.Name)]
[Trait("Time", "real")]
public sealed class SessionDivergenceTests
{
    [Fact]
    public void Join_StateThatDiffersFromTheHosts_IsACheckThatFailed()
    {
        // A host that says another hash than it has.
        using LyingPort port = new(new UdpPort(new IPEndPoint(IPAddress.Loopback, 0)));
        HostSession session = new(BuiltInScenes.Drop(), port, new StopwatchClock(), new HostOptions { Window = new(SimDuration.FromSeconds(0.2)), KeepAlive = SimDuration.FromSeconds(0.3) }, 5);
        using PeerThread host = new(session, port, "host");
        host.Start();
        using LiveTool client = LiveTool.Run($"join {port.LocalAddress} --unprotected --for-s 1");
        client.Ends(1);
        Assert.Contains("The committed state at T 1 s differs from the host's.", client.Error.ToString(), StringComparison.Ordinal);
        Assert.Matches("states held against the host's: 0 agreed, [1-9] differed", client.Output.ToString());
    }

    [Fact]
    public async Task Join_EventThatAStrangerTookOutOnItsWay_IsACheckThatFailed()
    {
        using EventTakingPort port = new(new UdpPort(new IPEndPoint(IPAddress.Loopback, 0)));
        HostSession session = new(
            BuiltInScenes.Drop(), port, new StopwatchClock(), new HostOptions { Window = new(SimDuration.FromSeconds(0.2)), KeepAlive = SimDuration.FromSeconds(0.3) }, 5);
        using PeerThread host = new(session, port, "host");
        host.Start();
        using LiveTool client = LiveTool.Run($"join {port.LocalAddress} --unprotected --for-s 2");
        Assert.True(host.WaitUntilRunning(LiveTool.Deadline));
        await host.Do(PlayerAction.SetVelocity(BodyId.OfScene(0), new Vector3D(2, 5, 0)));
        client.Ends(1);
        Assert.Contains("The committed state at T 1 s differs from the host's.", client.Error.ToString(), StringComparison.Ordinal);
        Assert.Contains("events: 0 accepted, 1 refused", client.Output.ToString(), StringComparison.Ordinal);

        // And which event it was, as the host has it and as it came here.
        Assert.Matches("The first that differs: at the host entry 1 of the log, at T [0-9.]+ s, Accepted: .*; here entry 1 of the log, at T [0-9.]+ s, ", client.Error.ToString());
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public async Task Join_EventThatComesTooLateForTheHistoryHere_IsLostAndACheckThatFailed(bool isAged)
    {
        using TemporaryFolder folder = new();
        using EventAgingPort port = new(new UdpPort(new IPEndPoint(IPAddress.Loopback, 0))) { IsAging = isAged };
        HostSession session = new(
            BuiltInScenes.Drop(), port, new StopwatchClock(), new HostOptions { Window = new(SimDuration.FromSeconds(0.2)), KeepAlive = SimDuration.FromSeconds(0.3) }, 5);
        using PeerThread host = new(session, port, "host");
        host.Start();
        using LiveTool client = LiveTool.Run($"join {port.LocalAddress} --unprotected --for-s 4 --record", folder["mine.lagsim"]);
        Assert.NotNull(client.Output.WaitFor(line => line.StartsWith("T 1 s ", StringComparison.Ordinal), LiveTool.Deadline));
        await host.Do(PlayerAction.SetVelocity(BodyId.OfScene(0), new Vector3D(2, 5, 0)));
        client.Ends(isAged ? 1 : 0);
        string said = client.Output.ToString();
        Assert.True(said.Contains(" 0 differed", StringComparison.Ordinal), $"{client}"); // the fresh copy came before anything was compared
        Assert.Equal(isAged, said.Contains("events lost 1", StringComparison.Ordinal));

        // The recording goes on in another file with the fresh copy, and both are named.
        string[] files = isAged ? [folder["mine.lagsim"], folder["mine.2.lagsim"]] : [folder["mine.lagsim"]];
        Assert.Contains($"recorded in {string.Join(", ", files)}\n", said.Replace("\r", "", StringComparison.Ordinal), StringComparison.Ordinal);
        Assert.Equal(files.Order(StringComparer.Ordinal), Directory.GetFiles(folder.Path).Order(StringComparer.Ordinal));
    }

    /// <summary>A port through which every state hash goes out with one bit changed.</summary>
    private sealed class LyingPort(UdpPort inner) : ChangingPort(inner)
    {
        protected override bool Change(UpdateDatagram update)
        {
            if (update.HasStateHash)
            {
                update.Hashes[0] ^= 1;
            }

            return update.HasStateHash;
        }
    }

    /// <summary>A port through which no accepted event goes out: each is said to be refused, and so leaves the world of who hears of it.</summary>
    private sealed class EventTakingPort(UdpPort inner) : ChangingPort(inner)
    {
        protected override bool Change(UpdateDatagram update)
        {
            UpdateEntry[] entries = update.Entries.ToArray();
            update.ClearEntries();
            return entries.Count(entry => update.TryAdd(Verdict.Invalid, entry.Event)) > 0;
        }
    }

    /// <summary>A port through which each event goes out as one of long ago, which nobody's history reaches back to; until its client comes in again.</summary>
    private sealed class EventAgingPort(UdpPort inner) : ChangingPort(inner)
    {
        private ulong? first; // the client's session by then

        internal bool IsAging { get; init; }

        protected override bool Change(UpdateDatagram update)
        {
            UpdateEntry[] entries = update.Entries.ToArray();
            first ??= update.SessionId;
            if (!IsAging || entries.Length == 0 || update.SessionId != first)
            {
                return false;
            }

            update.ClearEntries();
            foreach (UpdateEntry entry in entries)
            {
                SimTime old = entry.Event.Time - SimDuration.FromSeconds(0.9);
                Assert.True(update.TryAdd(entry.Verdict, PlayerAction.SetVelocity(entry.Event.Body, new Vector3D(2, 5, 0)).Stamp(old, entry.Event.Peer, entry.Event.Sequence)));
            }

            return true;
        }
    }

    /// <summary>A port whose updates go out changed.</summary>
    private abstract class ChangingPort(UdpPort inner) : IDatagramPort
    {
        private readonly UpdateDatagram update = new();
        private readonly byte[] changed = new byte[IDatagramPort.MaxDatagramBytes];

        public event Action? Arrived
        {
            add => inner.Arrived += value;
            remove => inner.Arrived -= value;
        }

        public PeerAddress LocalAddress => inner.LocalAddress;

        public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
        {
            bool isChanged = update.TryDecode(datagram, out _) && Change(update);
            inner.Send(isChanged ? changed.AsSpan(0, update.Encode(changed)) : datagram, to);
        }

        public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from) => inner.TryReceive(buffer, out length, out from);

        public void Dispose() => inner.Dispose();

        protected abstract bool Change(UpdateDatagram update);
    }
}
