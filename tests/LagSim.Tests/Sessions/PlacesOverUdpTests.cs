using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Net;
using System.Threading;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>Machines as sockets have them: what counts as one is the same over real UDP, by its IP address and not by its port.</summary>
[Trait("Time", "real")]
public sealed class PlacesOverUdpTests
{
    private static readonly TimeSpan Deadline = TimeSpan.FromSeconds(20);

    /// <summary>Only Linux has all of 127.0.0.0/8 without being told.</summary>
    [Fact]
    public void OneMachine_TakesNoMorePlacesThanItMay_AndAnotherGetsIn()
    {
        if (!OperatingSystem.IsLinux())
        {
            return;
        }

        using Group group = new();
        ClientSession[] greedy = Enumerable.Range(0, 10).Select(n => group.Join(2)).ToArray();
        Assert.True(group.RunUntil(() => greedy.All(s => s.State is SessionState.Running or SessionState.Ended)));
        Assert.Equal(SessionOptions.MaxClients / 2, greedy.Count(s => s.State == SessionState.Running));
        Assert.All(
            greedy.Where(s => s.State == SessionState.Ended),
            s => Assert.Contains("as many as may join from one address", s.EndReason, StringComparison.Ordinal));
        ClientSession[] honest = [group.Join(3), group.Join(4)];
        Assert.True(group.RunUntil(() => honest.All(s => s.State == SessionState.Running)), honest[0].EndReason);
        Assert.Equal((SessionOptions.MaxClients / 2) + 2, group.Host.ClientCount);
    }

    /// <summary>Sessions over sockets of their own, stepped by the test's thread whenever something has arrived.</summary>
    private sealed class Group : IDisposable
    {
        private readonly List<(Session Session, UdpPort Port)> all = [];
        private readonly AutoResetEvent arrived = new(false);
        private readonly StopwatchClock clock = new();

        internal Group()
        {
            UdpPort port = new(new IPEndPoint(IPAddress.Parse("127.0.0.1"), 0));
            Add(new HostSession(ScriptedActions.Box(), port, clock, new HostOptions(), 1), port);
        }

        internal HostSession Host => (HostSession)all[0].Session;

        public void Dispose()
        {
            foreach ((Session _, UdpPort port) in all)
            {
                port.Dispose();
            }

            arrived.Dispose();
        }

        internal ClientSession Join(int machine)
        {
            UdpPort port = new(new IPEndPoint(new IPAddress([127, 0, 0, (byte)machine]), 0));
            ClientSession session = new(null, port, clock, new ClientOptions(), all[0].Port.LocalAddress, Session.DrawNumber());
            Add(session, port);
            return session;
        }

        internal bool RunUntil(Func<bool> isSo)
        {
            Stopwatch watch = Stopwatch.StartNew();
            while (!isSo() && watch.Elapsed < Deadline)
            {
                foreach ((Session session, UdpPort _) in all)
                {
                    session.Step();
                }

                arrived.WaitOne(TimeSpan.FromMilliseconds(1));
            }

            return isSo();
        }

        private void Add(Session session, UdpPort port)
        {
            all.Add((session, port));
            port.Arrived += () => arrived.Set();
        }
    }
}
