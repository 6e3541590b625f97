using System;
using System.Collections.Generic;
using System.Linq;
using System.Net;
using System.Net.WebSockets;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Tests.Clocks;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Carriers;

/// <summary>WebSockets as a carrier: a message is a datagram, what is none ends the connection, and who is slow loses the oldest.</summary>
public sealed class WebSocketPortTests : IDisposable
{
    private static readonly IPAddress Machine = IPAddress.Parse("192.0.2.7");
    private static readonly TimeSpan Deadline = TimeSpan.FromSeconds(20);

    private readonly ManualClock clock = new();
    private readonly WebSocketHostPort host;

    public WebSocketPortTests() => host = new WebSocketHostPort(maxConnections: 6, clock);

    public void Dispose() => host.Dispose();

    [Fact]
    public async Task Send_EverySizeThereIs_ArrivesWholeBothWays()
    {
        using Connected one = await ConnectAsync();
        for (int size = 1; size <= IDatagramPort.MaxDatagramBytes; size += size < 100 ? 1 : 37)
        {
            byte[] datagram = Pattern(size);
            one.Port.Send(datagram, WebSocketClientPort.Host);
            (byte[] there, PeerAddress from) = await TakeAsync(host);
            Assert.Equal(datagram, there);
            host.Send(datagram, from);
            (byte[] back, PeerAddress answered) = await TakeAsync(one.Port);
            Assert.Equal(datagram, back);
            Assert.Equal(WebSocketClientPort.Host, answered);
            Assert.True(from.IsConnection);
            Assert.Equal(Machine, from.ToIPAddress());
        }

        Assert.Equal(0, host.Dropped + host.Superseded + host.Blocked + host.ConnectionsRefused);
    }

    [Fact]
    public async Task Send_TwoOfOneMachine_AreToldApart()
    {
        using Connected a = await ConnectAsync(), b = await ConnectAsync();
        a.Port.Send([1], WebSocketClientPort.Host);
        PeerAddress first = (await TakeAsync(host)).From;
        b.Port.Send([2], WebSocketClientPort.Host);
        PeerAddress second = (await TakeAsync(host)).From;
        Assert.NotEqual(first, second);
        Assert.True(first.IsSameMachine(second));
        Assert.True(first.IsSameMachine(PeerAddress.From(new IPEndPoint(Machine, 5)))); // what a machine may do counts whatever it comes over
        host.Send([3], second);
        host.Send([4], first);
        Assert.Equal([3], (await TakeAsync(b.Port)).Datagram);
        Assert.Equal([4], (await TakeAsync(a.Port)).Datagram);
    }

    [Fact]
    public async Task Send_EmptyOversizeOrElsewhere_IsRefused()
    {
        using Connected one = await ConnectAsync();
        PeerAddress connection = PeerAddress.OfConnection(Machine, 1);
        Assert.Contains("this one has 0", Refused(() => host.Send(default, connection)), StringComparison.Ordinal);
        Assert.Contains("1201", Refused(() => host.Send(new byte[1201], connection)), StringComparison.Ordinal);
        Assert.Contains("'192.0.2.7:5'", Refused(() => host.Send([1], PeerAddress.From(new IPEndPoint(Machine, 5)))), StringComparison.Ordinal);
        Assert.Contains("1199", Refused(() => host.TryReceive(new byte[1199], out _, out _)), StringComparison.Ordinal);
        Assert.Contains("this one has 0", Refused(() => one.Port.Send(default, WebSocketClientPort.Host)), StringComparison.Ordinal);
        Assert.Contains("1201", Refused(() => one.Port.Send(new byte[1201], WebSocketClientPort.Host)), StringComparison.Ordinal);
        Assert.Contains("'virtual:3'", Refused(() => one.Port.Send([1], PeerAddress.Virtual(3))), StringComparison.Ordinal);
        Assert.Contains("1199", Refused(() => one.Port.TryReceive(new byte[1199], out _, out _)), StringComparison.Ordinal);
        Assert.Contains("http://x/", Refused(() => new WebSocketClientPort(new Uri("http://x/"))), StringComparison.Ordinal);
        Assert.Throws<ArgumentOutOfRangeException>(() => new WebSocketHostPort(0));
        Assert.Throws<ArgumentOutOfRangeException>(() => new WebSocketHostPort(WebSocketHostPort.MaxConnections + 1));
    }

    /// <summary>Whatever one connection sends, in whatever pieces, another is not disturbed, and the port takes nothing that is no
    /// datagram.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(4)]
    public async Task Receive_MessagesOfEveryKind_OnlyDatagramsArrive(int seed)
    {
        using Connected quiet = await ConnectAsync();
        Random random = new(seed);
        for (int n = 0; n < 40; n++)
        {
            SocketPair pair = new();
            Task serving = host.ServeAsync(pair.Server, Machine, TestContext.Current.CancellationToken);
            int size = random.Next(4) switch { 0 => 0, 1 => random.Next(1201, 9000), _ => random.Next(1, 1201) };
            bool isText = random.Next(4) == 0;
            bool isDatagram = !isText && size is >= 1 and <= IDatagramPort.MaxDatagramBytes;
            byte[] message = isText ? [.. Pattern(size).Select(one => (byte)(one & 0x7f))] : Pattern(size);
            int cut = random.Next(size + 1);
            bool isWhole = random.Next(2) == 0;
            WebSocketMessageType type = isText ? WebSocketMessageType.Text : WebSocketMessageType.Binary;
            Task sending = SendAsync(pair.Client, message, isWhole ? size : cut, type);
            if (isDatagram)
            {
                Assert.Equal(message, (await TakeAsync(host)).Datagram);
                pair.Client.Abort();
            }
            else
            {
                WebSocketCloseStatus expected = isText ? WebSocketCloseStatus.InvalidMessageType
                    : size == 0 ? WebSocketCloseStatus.PolicyViolation : WebSocketCloseStatus.MessageTooBig;
                WebSocketReceiveResult end = await pair.Client.ReceiveAsync(new byte[8], TestContext.Current.CancellationToken);
                Assert.Equal(expected, end.CloseStatus);
                Assert.Contains("datagram", end.CloseStatusDescription, StringComparison.Ordinal);
                pair.Client.Abort();
            }

            await serving.WaitAsync(Deadline, TestContext.Current.CancellationToken);
            await Task.WhenAny(sending).WaitAsync(Deadline, TestContext.Current.CancellationToken);
        }

        Assert.False(host.TryReceive(new byte[IDatagramPort.MaxDatagramBytes], out _, out _));
        quiet.Port.Send([9], WebSocketClientPort.Host);
        Assert.Equal([9], (await TakeAsync(host)).Datagram);
    }

    [Fact]
    public async Task Send_ToOneThatTakesNothing_TheNewestWaitAndTheOldestAreLost()
    {
        const int sent = 1000;
        using Connected one = await ConnectAsync();
        PeerAddress to = await MeetAsync(one);
        one.Pair.StopReading();
        for (int n = 0; n < sent; n++)
        {
            host.Send([.. BitConverter.GetBytes(n), .. Pattern(500)], to);
        }

        one.Pair.GoOnReading();
        List<int> arrived = [];
        while (arrived.Count == 0 || arrived[^1] != sent - 1)
        {
            arrived.Add(BitConverter.ToInt32((await TakeAsync(one.Port)).Datagram));
        }

        Assert.Equal(arrived.Order(), arrived);
        Assert.Equal(sent, arrived.Count + host.Superseded);
        Assert.Equal(Enumerable.Range(sent - WebSocketLink.QueueSlots, WebSocketLink.QueueSlots), arrived.TakeLast(WebSocketLink.QueueSlots));
        Assert.True(arrived.Count < 2 * WebSocketLink.QueueSlots, $"{arrived.Count} datagrams had waited.");
    }

    [Fact]
    public async Task Send_ToOneThatHasTakenNothingForFiveSeconds_EndsTheConnection()
    {
        using Connected one = await ConnectAsync();
        PeerAddress to = await MeetAsync(one);
        one.Pair.StopReading();
        await FillAsync(to);
        clock.Now += SimDuration.FromSeconds(WebSocketHostPort.MaxBlockedSeconds) - host.LinkOf(to)!.BlockedFor;
        host.Send([1], to);
        Assert.Equal((0, 1), (host.Blocked, host.Connections));
        clock.Now += SimDuration.FromMilliseconds(1);
        host.Send([1], to);
        Assert.Equal(1, host.Blocked);
        await UntilAsync(() => host.Connections == 0);
        host.Send([1], to);
        Assert.Equal(1, host.Unconnected);
    }

    /// <summary>The control of the one above: who takes something, however slowly, stays.</summary>
    [Fact]
    public async Task Send_ToOneThatTakesALittle_GoesOn()
    {
        using Connected one = await ConnectAsync();
        PeerAddress to = await MeetAsync(one);
        for (int n = 0; n < 5; n++)
        {
            one.Pair.StopReading();
            await FillAsync(to);
            clock.Now += SimDuration.FromSeconds(WebSocketHostPort.MaxBlockedSeconds - 1);
            one.Pair.GoOnReading();
            host.Send([77, 1, 1, 1, 1], to);
            while ((await TakeAsync(one.Port)).Datagram.Length != 5)
            {
            }
        }

        Assert.Equal((0, 1), (host.Blocked, host.Connections));
    }

    [Fact]
    public async Task Connect_OneMoreThanThereIsRoomForOfAMachine_IsToldToTryAgainLater()
    {
        using Connected a = await ConnectAsync(), b = await ConnectAsync();
        Connected c = await ConnectAsync();
        SocketPair more = new();
        Task refused = host.ServeAsync(more.Server, Machine, TestContext.Current.CancellationToken);
        WebSocketReceiveResult end = await more.Client.ReceiveAsync(new byte[8], TestContext.Current.CancellationToken);
        Assert.Equal((1013, "There is no room for another connection."), ((int)end.CloseStatus!, end.CloseStatusDescription));
        more.Client.Abort();
        await refused.WaitAsync(Deadline, TestContext.Current.CancellationToken);
        Assert.Equal((1, 3), (host.ConnectionsRefused, host.Connections));

        c.Dispose();
        await UntilAsync(() => host.Connections == 2);
        using Connected again = await ConnectAsync();
        await MeetAsync(again);
        await MeetAsync(a);
    }

    /// <summary>A machine that opens connections and takes no part cannot keep others out for long, whatever it sends, nor who takes part lose
    /// its place to it.</summary>
    [Fact]
    public async Task Connect_WhileOthersHaveNoPlaceInTheSession_TakesThePlaceOfTheOneThatWasThereForLongest()
    {
        using Connected stranger = await ConnectAsync();
        clock.Now += SimDuration.FromSeconds(1);
        using Connected player = await ConnectAsync(), newest = await ConnectAsync();
        clock.Now += SimDuration.FromSeconds(WebSocketHostPort.SafeSeconds - 1);
        Assert.False(host.HasRoomFor(Machine));
        SocketPair early = new();
        Task refused = host.ServeAsync(early.Server, Machine, TestContext.Current.CancellationToken);
        Assert.Equal(1013, (int)(await early.Client.ReceiveAsync(new byte[8], TestContext.Current.CancellationToken)).CloseStatus!);
        early.Client.Abort();
        await refused.WaitAsync(Deadline, TestContext.Current.CancellationToken);

        host.NoteSeated(await MeetAsync(player));
        await MeetAsync(stranger); // which sends something, too
        clock.Now += SimDuration.FromMilliseconds(1);
        Assert.True(host.HasRoomFor(Machine));
        using Connected late = await ConnectAsync();
        await MeetAsync(late);
        await MeetAsync(player);
        await UntilAsync(() => !stranger.Port.IsConnected);
        Assert.Equal(3, host.Connections);
        PeerAddress elsewhere = await MeetAsync(await ConnectAsync(IPAddress.Parse("192.0.2.8"))); // another machine has room of its own
        Assert.Equal("192.0.2.8", elsewhere.ToIPAddress().ToString());
    }

    /// <summary>Two machines with half of all connections each, none of which is in the session.</summary>
    [Fact]
    public async Task Connect_WhileTwoMachinesHaveAllConnections_IsInAtOnce()
    {
        using Connected a = await ConnectAsync(), b = await ConnectAsync(), c = await ConnectAsync();
        IPAddress other = IPAddress.Parse("192.0.2.8"), third = IPAddress.Parse("192.0.2.9");
        using Connected d = await ConnectAsync(other), e = await ConnectAsync(other), f = await ConnectAsync(other);
        foreach (Connected one in new[] { a, b, c })
        {
            host.NoteSeated(await MeetAsync(one));
        }

        using Connected honest = await ConnectAsync(third);
        await MeetAsync(honest);
        await UntilAsync(() => !d.Port.IsConnected);
        Assert.All([a, b, c, e, f, honest], one => Assert.True(one.Port.IsConnected));
        Assert.Equal((6, 0), (host.Connections, host.ConnectionsRefused));
    }

    [Fact]
    public async Task Client_WhoseConnectionBreaks_ConnectsAgainAfterLongerAndLongerPauses()
    {
        Queue<SocketPair?> offered = new([new SocketPair(), null, null, null, null, null, new SocketPair()]);
        List<double> pauses = [];
        SocketPair? last = null;
        using WebSocketClientPort port = new(
            stop =>
            {
                last = offered.Dequeue();
                if (last is null)
                {
                    throw new WebSocketException("Nobody is there.");
                }

                _ = host.ServeAsync(last.Server, Machine, stop);
                return Task.FromResult(last.Client);
            },
            (pause, stop) =>
            {
                lock (pauses)
                {
                    pauses.Add(pause.TotalSeconds);
                }

                return Task.Delay(1, stop);
            },
            clock);
        await UntilAsync(() => port.IsConnected);
        port.Send([1], WebSocketClientPort.Host);
        PeerAddress before = (await TakeAsync(host)).From;
        last!.Server.Abort();
        await UntilAsync(() => offered.Count == 0 && port.IsConnected);
        Assert.Equal([0.2, 0.4, 0.8, 1.6, 2, 2], pauses);
        port.Send([2], WebSocketClientPort.Host);
        (byte[] datagram, PeerAddress after) = await TakeAsync(host);
        Assert.Equal([2], datagram);
        Assert.NotEqual(before, after);
        Assert.Equal(1, port.Reconnections);
        port.Dispose();
        await port.Running.WaitAsync(Deadline, TestContext.Current.CancellationToken);
        Assert.Throws<ObjectDisposedException>(() => port.Send([1], WebSocketClientPort.Host));
    }

    [Fact]
    public async Task Client_WithoutAConnection_SaysWhyAndCountsWhatIsLost()
    {
        using WebSocketClientPort port = new(
            _ => Task.FromException<WebSocket>(new WebSocketException("Nobody is there.")), (_, stop) => Task.Delay(Timeout.Infinite, stop), clock);
        await UntilAsync(() => port.Failure is not null);
        port.Send([1], WebSocketClientPort.Host);
        Assert.Equal((1, "Nobody is there.", false), (port.Unconnected, port.Failure, port.IsConnected));
    }

    [Fact]
    public async Task Dispose_RightAfterASend_SendsIt()
    {
        using Connected one = await ConnectAsync();
        await MeetAsync(one);
        for (byte n = 0; n < 20; n++)
        {
            one.Port.Send([n], WebSocketClientPort.Host);
        }

        one.Port.Dispose();
        for (byte n = 0; n < 20; n++)
        {
            Assert.Equal([n], (await TakeAsync(host)).Datagram);
        }
    }

    [Fact]
    public async Task Dispose_OfTheHost_TellsClients()
    {
        SocketPair pair = new();
        Task serving = host.ServeAsync(pair.Server, Machine, TestContext.Current.CancellationToken);
        host.Dispose();
        WebSocketReceiveResult end = await pair.Client.ReceiveAsync(new byte[8], TestContext.Current.CancellationToken);
        Assert.Equal(WebSocketCloseStatus.EndpointUnavailable, end.CloseStatus);
        pair.Client.Abort();
        await serving.WaitAsync(Deadline, TestContext.Current.CancellationToken);
        Assert.Throws<ObjectDisposedException>(() => host.Send([1], PeerAddress.OfConnection(Machine, 1)));
    }

    /// <summary>One that stops reading but goes on asking for things costs 64 datagrams, then its connection, and then its place.</summary>
    [Fact]
    public async Task Session_WhoseClientStopsReading_LosesItsConnectionAndThenItsPlace()
    {
        Scene scene = new SceneBuilder("stop").AddBody("ball", new BodySpec(0.5, 1, 0.5), Vector3D.Zero).Build();
        HostSession session = new(scene, host, clock, new HostOptions { Warmup = false, Timeout = SimDuration.FromSeconds(3) }, 1);
        using Connected one = await ConnectAsync();
        ClientSession client = new(
            null, one.Port, clock, new ClientOptions { Warmup = false, Timeout = SimDuration.FromSeconds(3) }, WebSocketClientPort.Host, 2);
        await StepAsync(session, client, () => client.State == SessionState.Running);
        Assert.Equal(2, session.Roster.Count);

        one.Pair.StopReading();
        PeerAddress to = session.Links[0].Address;
        await FillAsync(to); // what a slow network holds is full
        await StepAsync(session, client, () => host.Blocked == 1);
        Assert.True(host.Superseded > 0);
        await StepAsync(session, client, () => session.Roster.Count == 1);
        Assert.Equal(0, host.Connections);
    }

    /// <summary>The session tells the port who is in: a client keeps its connection for as long as it is heard, and no stranger keeps one by
    /// sending what is nothing to the session.</summary>
    [Fact]
    public async Task Session_WhileStrangersComeAndSend_ItsClientKeepsItsConnection()
    {
        Scene scene = new SceneBuilder("keep").AddBody("ball", new BodySpec(0.5, 1, 0.5), Vector3D.Zero).Build();
        HostSession session = new(scene, host, clock, new HostOptions { Warmup = false }, 1);
        using Connected one = await ConnectAsync();
        ClientSession client = new(null, one.Port, clock, new ClientOptions { Warmup = false }, WebSocketClientPort.Host, 2);
        await StepAsync(session, client, () => client.State == SessionState.Running);
        using Connected a = await ConnectAsync(), b = await ConnectAsync();
        for (int second = 0; second <= WebSocketHostPort.SafeSeconds; second++)
        {
            SimTime next = clock.Now + SimDuration.FromSeconds(1);
            a.Port.Send([7], WebSocketClientPort.Host);
            b.Port.Send([7], WebSocketClientPort.Host);
            clock.Now += SimDuration.FromMilliseconds(900);
            await StepAsync(session, client, () => clock.Now >= next);
        }

        using Connected c = await ConnectAsync(), d = await ConnectAsync();
        await UntilAsync(() => !a.Port.IsConnected && !b.Port.IsConnected);
        Assert.True(one.Port.IsConnected);
        Assert.Equal((3, 2), (host.Connections, session.Roster.Count));
    }

    private static async Task<(byte[] Datagram, PeerAddress From)> TakeAsync(IDatagramPort port)
    {
        byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
        int length = 0;
        PeerAddress from = default;
        await UntilAsync(() => port.TryReceive(buffer, out length, out from));
        return (buffer[..length], from);
    }

    private static async Task UntilAsync(Func<bool> isSo)
    {
        using CancellationTokenSource patience = new(Deadline);
        while (!isSo())
        {
            await Task.Delay(1, patience.Token);
        }
    }

    private static byte[] Pattern(int size) => [.. Enumerable.Range(0, size).Select(n => (byte)((n * 31) + size))];

    private static string Refused(Action what) => Assert.ThrowsAny<ArgumentException>(what).Message;

    private static async Task SendAsync(WebSocket socket, byte[] message, int cut, WebSocketMessageType type)
    {
        try
        {
            if (cut < message.Length)
            {
                await socket.SendAsync(message.AsMemory(0, cut), type, endOfMessage: false, CancellationToken.None);
            }

            await socket.SendAsync(cut < message.Length ? message.AsMemory(cut) : message, type, endOfMessage: true, CancellationToken.None);
        }
        catch (Exception over) when (over is WebSocketException or OperationCanceledException or InvalidOperationException or System.IO.IOException)
        {
            // The host ended the connection before it had all of it.
        }
    }

    private async Task StepAsync(HostSession session, ClientSession client, Func<bool> isSo)
    {
        for (int n = 0; n < 4000 && !isSo(); n++)
        {
            clock.Now += SimDuration.FromMilliseconds(10);
            session.Step();
            client.Step();
            await Task.Delay(1, TestContext.Current.CancellationToken);
        }

        Assert.True(isSo());
    }

    /// <summary>Sends more than there is room for, until the next has to wait.</summary>
    private async Task FillAsync(PeerAddress to)
    {
        for (int n = 0; n < 2 * WebSocketLink.QueueSlots; n++)
        {
            host.Send(new byte[1000], to);
        }

        await UntilAsync(() =>
        {
            clock.Now += SimDuration.FromMilliseconds(1);
            return host.LinkOf(to)!.BlockedFor >= SimDuration.FromMilliseconds(20);
        });
    }

    private async Task<PeerAddress> MeetAsync(Connected one)
    {
        one.Port.Send([42], WebSocketClientPort.Host);
        (byte[] datagram, PeerAddress from) = await TakeAsync(host);
        Assert.Equal([42], datagram);
        return from;
    }

    private async Task<Connected> ConnectAsync(IPAddress? machine = null)
    {
        SocketPair pair = new();
        _ = host.ServeAsync(pair.Server, machine ?? Machine, TestContext.Current.CancellationToken);
        WebSocketClientPort port = new(
            _ => Task.FromResult(pair.Client), (_, stop) => Task.Delay(Timeout.Infinite, stop), clock);
        await UntilAsync(() => port.IsConnected);
        return new Connected(pair, port);
    }

    private sealed record Connected(SocketPair Pair, WebSocketClientPort Port) : IDisposable
    {
        public void Dispose()
        {
            Pair.GoOnReading();
            Port.Dispose();
        }
    }
}
