using System;
using System.ComponentModel;
using System.Diagnostics;
using System.IO;
using System.Net;
using System.Net.Sockets;
using System.Runtime.InteropServices;
using System.Threading;
using LagSim.Testing.Links;
using Microsoft.Win32.SafeHandles;
using Xunit;

namespace LagSim.Tests.Links;

/// <summary>Two network namespaces with a virtual Ethernet between them and a token bucket of the kernel's on the way there; datagrams sent through it in real time.</summary>
/// <remarks>All on one thread of its own: it is in the one namespace when it makes the sockets of the one, and processes that it starts are in its namespace too. The namespaces have
/// no names, so they are gone with the thread and the sockets, however the test ends.</remarks>
internal static class KernelLink
{
    private const int NewNetwork = 0x4000_0000; // CLONE_NEWNET
    private const int SocketLevel = 1, SendBufferForce = 32, ReceiveBufferForce = 33, TimestampNanoseconds = 35; // SOL_SOCKET, SO_...
    private const int DontWait = 0x40; // MSG_DONTWAIT
    private const string Sender = "10.77.0.1", Receiver = "10.77.0.2", SenderMac = "02:00:00:00:77:01", ReceiverMac = "02:00:00:00:77:02";

    /// <summary>Sends all and says when each was really sent and when it arrived, in seconds; NaN what did not. Skips the test where there is no such link to be had.</summary>
    /// <param name="bottleneck">What to ask the kernel for.</param>
    /// <param name="pattern">When to send how many bytes, in seconds from the start.</param>
    internal static Passage[] Send(Bottleneck bottleneck, (double At, int Bytes)[] pattern)
    {
        Assert.SkipUnless(OperatingSystem.IsLinux() && Environment.Is64BitProcess, "Only Linux has network namespaces and a token bucket filter.");
        Passage[]? passages = null;
        string? missing = null;
        Exception? failure = null;
        Thread thread = new(() =>
        {
            try
            {
                passages = SendInside(bottleneck, pattern);
            }
            catch (NotToBeHadException reason)
            {
                missing = reason.Message;
            }
            catch (Exception thrown)
            {
                failure = thrown;
            }
        });
        thread.Start();
        thread.Join();
        Assert.SkipWhen(missing is not null, $"No link of the kernel's is to be had: {missing}");
        return failure is null ? passages! : throw new InvalidOperationException("Sending through the kernel's link failed.", failure);
    }

    private static Passage[] SendInside(Bottleneck bottleneck, (double At, int Bytes)[] pattern)
    {
        Enter("the sender's");
        using SafeFileHandle there = File.OpenHandle("/proc/thread-self/ns/net");
        Enter("the receiver's");
        Run("ip", $"link add r address {ReceiverMac} type veth peer name s address {SenderMac} netns /proc/{Environment.ProcessId}/fd/{there.DangerousGetHandle()}");
        Up("r", Receiver, Sender, SenderMac);
        using Socket receiver = Open(Receiver);
        receiver.SetRawSocketOption(SocketLevel, TimestampNanoseconds, BitConverter.GetBytes(1));
        receiver.SetRawSocketOption(SocketLevel, ReceiveBufferForce, BitConverter.GetBytes(1 << 24));

        if (SetNamespace((int)there.DangerousGetHandle(), NewNetwork) != 0)
        {
            throw new NotToBeHadException($"setns fails ({Marshal.GetLastPInvokeErrorMessage()}).");
        }

        Up("s", Sender, Receiver, ReceiverMac);
        Run("tc", FormattableString.Invariant(
            $"qdisc add dev s root tbf rate {bottleneck.RateBitsPerSecond}bit burst {bottleneck.BurstBytes} latency {bottleneck.QueueMilliseconds}ms"));
        using Socket sender = Open(Sender);
        sender.SetRawSocketOption(SocketLevel, SendBufferForce, BitConverter.GetBytes(1 << 24)); // what waits in the queue is still the socket's
        sender.Connect(receiver.LocalEndPoint!);
        return Exchange(sender, receiver, pattern, 0.3 + (8.0 * bottleneck.LimitBytes / bottleneck.RateBitsPerSecond));
    }

    /// <param name="sender">Sends.</param>
    /// <param name="receiver">Receives.</param>
    /// <param name="pattern">What.</param>
    /// <param name="drain">After how many seconds nothing of it can be under way any more.</param>
    private static Passage[] Exchange(Socket sender, Socket receiver, (double At, int Bytes)[] pattern, double drain)
    {
        using Inbox inbox = new(receiver);
        var passages = new Passage[pattern.Length];
        Array.Fill(passages, new Passage(0, 0, double.NaN));
        byte[] datagram = new byte[1_500];
        Stopwatch watch = Stopwatch.StartNew();
        for (int next = 0; next < pattern.Length || watch.Elapsed.TotalSeconds < pattern[^1].At + drain;)
        {
            for (; next < pattern.Length && watch.Elapsed.TotalSeconds >= pattern[next].At; next++)
            {
                BitConverter.TryWriteBytes(datagram, next);
                double before = Now();
                try
                {
                    sender.Send(datagram.AsSpan(0, pattern[next].Bytes));
                }
                catch (SocketException full) when (full.SocketErrorCode == SocketError.NoBufferSpaceAvailable)
                {
                    // It was dropped, and this kernel says so.
                }

                passages[next] = passages[next] with { Sent = before, Took = Now() - before };
            }

            while (inbox.TryTake(out int number, out double at))
            {
                passages[number] = passages[number] with { Arrived = at };
            }

            receiver.Poll(1_000, SelectMode.SelectRead); // until something comes, a millisecond at most
        }

        return passages;
    }

    private static void Enter(string whose)
    {
        if (Unshare(NewNetwork) != 0)
        {
            throw new NotToBeHadException($"{whose} namespace cannot be made ({Marshal.GetLastPInvokeErrorMessage()}).");
        }
    }

    /// <summary>Nothing but the test's datagrams goes over the link: no questions for addresses, no IPv6.</summary>
    private static void Up(string device, string own, string other, string otherMac)
    {
        Run("ip", $"link set {device} addrgenmode none");
        Run("ip", $"addr add {own}/24 dev {device}");
        Run("ip", $"link set {device} up");
        Run("ip", $"neigh replace {other} lladdr {otherMac} dev {device} nud permanent");
    }

    private static Socket Open(string address)
    {
        Socket socket = new(AddressFamily.InterNetwork, SocketType.Dgram, ProtocolType.Udp);
        socket.Bind(new IPEndPoint(IPAddress.Parse(address), 0));
        return socket;
    }

    private static void Run(string tool, string arguments)
    {
        try
        {
            using Process process = Process.Start(new ProcessStartInfo(tool, arguments) { RedirectStandardError = true })!;
            string said = process.StandardError.ReadToEnd();
            process.WaitForExit();
            if (process.ExitCode != 0)
            {
                throw new NotToBeHadException($"'{tool} {arguments}' ends with {process.ExitCode}: {said.Trim()}");
            }
        }
        catch (Win32Exception)
        {
            throw new NotToBeHadException($"there is no '{tool}'.");
        }
    }

    /// <summary>The clock by which the kernel stamps what arrives, in seconds.</summary>
    private static double Now() => (DateTime.UtcNow - DateTime.UnixEpoch).Ticks % (86_400L * TimeSpan.TicksPerSecond) / (double)TimeSpan.TicksPerSecond;

    [DllImport("libc", EntryPoint = "unshare", SetLastError = true)]
    private static extern int Unshare(int what);

    [DllImport("libc", EntryPoint = "setns", SetLastError = true)]
    private static extern int SetNamespace(int handle, int kind);

    [DllImport("libc", EntryPoint = "recvmsg", SetLastError = true)]
    private static extern nint ReceiveMessage(int socket, nint message, int flags);

    /// <summary>What became of one datagram, in seconds of one clock.</summary>
    /// <param name="Sent">Just before it was handed to the kernel.</param>
    /// <param name="Took">How long that took: how uncertain <paramref name="Sent"/> is.</param>
    /// <param name="Arrived">When the kernel had it at the other end; NaN if it never came.</param>
    internal readonly record struct Passage(double Sent, double Took, double Arrived);

    private sealed class NotToBeHadException(string message) : Exception(message);

    /// <summary>Takes datagrams with the kernel's own times of arrival, which do not depend on when somebody looks.</summary>
    private sealed class Inbox : IDisposable
    {
        // struct msghdr, then an iovec, control data and the datagram, as a process of 64 bits has them.
        private const int Vector = 64, Control = 128, ControlBytes = 128, Data = 256, DataBytes = 2_048;

        private readonly Socket socket;
        private readonly nint memory = Marshal.AllocHGlobal(Data + DataBytes);

        internal Inbox(Socket socket) => this.socket = socket;

        public void Dispose() => Marshal.FreeHGlobal(memory);

        internal bool TryTake(out int number, out double at)
        {
            for (int i = 0; i < Control; i += sizeof(long))
            {
                Marshal.WriteInt64(memory, i, 0);
            }

            Marshal.WriteInt64(memory, 16, memory + Vector);
            Marshal.WriteInt64(memory, 24, 1);
            Marshal.WriteInt64(memory, 32, memory + Control);
            Marshal.WriteInt64(memory, 40, ControlBytes);
            Marshal.WriteInt64(memory, Vector, memory + Data);
            Marshal.WriteInt64(memory, Vector + 8, DataBytes);
            if (ReceiveMessage((int)socket.Handle, memory, DontWait) < sizeof(int))
            {
                number = 0;
                at = 0;
                return false;
            }

            Assert.Equal(TimestampNanoseconds, Marshal.ReadInt32(memory, Control + 12));
            number = Marshal.ReadInt32(memory, Data);
            at = (Marshal.ReadInt64(memory, Control + 16) % 86_400) + (Marshal.ReadInt64(memory, Control + 24) * 1e-9);
            return true;
        }
    }
}
