using System;
using System.Collections.Generic;
using System.Linq;
using System.Net;
using System.Net.Sockets;
using System.Threading.Tasks;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Where a host is, as users write it.</summary>
public sealed class EndPointTextTests
{
    [Theory]
    [InlineData("127.0.0.1:5000", "127.0.0.1", 5000)]
    [InlineData("[::1]:1", "::1", 1)]
    [InlineData("[2001:db8::7]:65535", "2001:db8::7", 65535)]
    [InlineData("some.name:80", "some.name", 80)]
    public void Parse_AddressOrName_IsTakenApart(string text, string host, int port) => Assert.Equal((host, port), EndPointText.Parse(text));

    [Theory]
    [InlineData("nowhere")]
    [InlineData("")]
    [InlineData(":5000")]
    [InlineData("::1:5000")]
    [InlineData("[::1]")]
    [InlineData("[127.0.0.1]:5000")]
    [InlineData("[x]:5000")]
    [InlineData("[]:5000")]
    [InlineData("a b:5000")]
    public void Parse_WhatSaysNoHost_IsRefusedWithExamples(string text)
    {
        string message = Assert.Throws<UsageException>(() => EndPointText.Parse(text)).Message;
        Assert.Contains($"'{text}'", message, StringComparison.Ordinal);
        Assert.Contains("[::1]:5000", message, StringComparison.Ordinal);
        Assert.Equal(2, Tool.Run("join", text).ExitCode);
    }

    [Theory]
    [InlineData("a:0")]
    [InlineData("a:65536")]
    [InlineData("a:x")]
    [InlineData("a:")]
    [InlineData("a:-1")]
    public void Parse_PortOutOfRange_IsRefused(string text) =>
        Assert.Contains("between 1 and 65535", Assert.Throws<UsageException>(() => EndPointText.Parse(text)).Message, StringComparison.Ordinal);

    [Fact]
    public void Resolve_NamesAndLiterals_GivesTheAddress()
    {
        Assert.Equal(new IPEndPoint(IPAddress.Loopback, 7), EndPointText.Resolve("127.0.0.1:7", "join", TestContext.Current.CancellationToken));
        Assert.Equal(new IPEndPoint(IPAddress.IPv6Loopback, 7), EndPointText.Resolve("[::1]:7", "join", TestContext.Current.CancellationToken));
        Assert.True(IPAddress.IsLoopback(EndPointText.Resolve("localhost:7", "join", TestContext.Current.CancellationToken).Address));
    }

    [Theory]
    [InlineData("0.0.0.0:7", "'0.0.0.0:7'")]
    [InlineData("[::]:7", "'[::]:7'")]
    [InlineData("[::ffff:0.0.0.0]:7", "'0.0.0.0:7'")]
    public void Resolve_AddressOfNoMachine_IsRefusedAtOnce(string text, string named)
    {
        // A client would wait out its time-out, ten minutes here, for an answer that cannot come.
        Tool.Refuses(3, ["join", text, "--timeout-s", "600"], $"{named} is no host to join: it takes the address of one machine and a port from 1 to 65535.");
        Tool.Refuses(3, ["relay", text, "--profile", "lan"], $"{named} is no host to relay to: it takes the address of one machine and a port from 1 to 65535.");
    }

    /// <summary>The first is the system's choice, and after it comes one of each kind in turn; a relay, which takes one, takes IPv4.</summary>
    [Theory]
    [InlineData("2001:db8::1 192.0.2.1", "2001:db8::1 192.0.2.1", "192.0.2.1")]
    [InlineData("192.0.2.1 2001:db8::1", "192.0.2.1 2001:db8::1", "192.0.2.1")]
    [InlineData("2001:db8::1 2001:db8::2 2001:db8::3 192.0.2.1 192.0.2.2", "2001:db8::1 192.0.2.1 2001:db8::2 192.0.2.2 2001:db8::3", "192.0.2.1")]
    [InlineData("192.0.2.1 192.0.2.1 192.0.2.2", "192.0.2.1 192.0.2.2", "192.0.2.1")]
    [InlineData("0.0.0.0 192.0.2.1", "192.0.2.1", "192.0.2.1")]
    [InlineData("192.0.2.1 192.0.2.2 192.0.2.3 192.0.2.4 192.0.2.5 192.0.2.6 192.0.2.7", "192.0.2.1 192.0.2.2 192.0.2.3 192.0.2.4 192.0.2.5 192.0.2.6", "192.0.2.1")]
    public void ResolveAll_NameOfSeveralAddresses_GivesThemInTurn(string known, string tried, string one)
    {
        Assert.SkipUnless(Socket.OSSupportsIPv6, "Without IPv6 on this machine only IPv4 is tried.");
        Assert.Equal(tried.Split(' ').Select(address => new IPEndPoint(IPAddress.Parse(address), 7)), All(known));
        Assert.Equal(IPAddress.Parse(one), EndPointText.First(All(known)).Address);
    }

    [Fact]
    public void ResolveAll_NameWithoutAnAddress_IsRefusedByName() =>
        Assert.Equal("The host 'some.name' has no IP address.", Assert.Throws<InputException>(() => All("")).Message);

    private static IReadOnlyList<IPEndPoint> All(string known) => EndPointText.ResolveAll(
        "some.name:7",
        "join",
        TestContext.Current.CancellationToken,
        (_, _) => Task.FromResult<IPAddress[]>([.. known.Split(' ', StringSplitOptions.RemoveEmptyEntries).Select(IPAddress.Parse)]));

    [Fact]
    public void Resolve_UnknownName_IsRefusedByName()
    {
        Tool.Refuses(3, ["join", "no-such-host.invalid:5000"], "The host 'no-such-host.invalid' is not known");
        Tool.Refuses(3, ["relay", "no-such-host.invalid:5000", "--profile", "lan"], "The host 'no-such-host.invalid' is not known");
        Tool.Refuses(3, ["join", new string('x', 300) + ":5000"], "is not known");
    }

    /// <summary>An IPv4 address in the clothes of IPv6 is reached over IPv4, and known as that.</summary>
    [Theory]
    [InlineData("[::ffff:127.0.0.1]:7", "127.0.0.1:7")]
    [InlineData("[0:0::1]:7", "[::1]:7")]
    [InlineData("Some.Name:7", "some.name:7")]
    [InlineData("[FE80::1%eth0]:7", "[fe80::1%eth0]:7")]
    public void Spelling_OfWhatIsWrittenInSeveralWays_IsOne(string text, string one) => Assert.Equal(one, EndPointText.Spelling(text));

    [Fact]
    public void Resolve_MappedIPv4_IsIPv4()
    {
        Assert.Equal(new IPEndPoint(IPAddress.Loopback, 7), EndPointText.Resolve("[::ffff:127.0.0.1]:7", "join", TestContext.Current.CancellationToken));
        Assert.Equal([new IPEndPoint(IPAddress.Loopback, 7)], All("127.0.0.1 ::ffff:127.0.0.1"));
        Assert.Equal(IPAddress.Loopback, EndPointText.ParseLocal("--address", "::ffff:127.0.0.1"));
    }

    /// <summary>A zone is one of this machine's networks. It is written as it is read, by name.</summary>
    [Fact]
    public void Resolve_AddressWithAZone_KeepsItByName()
    {
        Assert.SkipUnless(OperatingSystem.IsLinux() && Socket.OSSupportsIPv6, "Interfaces have these names on Linux.");
        IPEndPoint found = EndPointText.Resolve("[fe80::1%lo]:7", "join", TestContext.Current.CancellationToken);
        Assert.NotEqual(0, found.Address.ScopeId);
        Assert.Equal(("fe80::1%lo", "[fe80::1%lo]:7"), (EndPointText.Write(found.Address), EndPointText.Write(found)));
        Assert.NotEqual("fe80::1%lo", found.Address.ToString()); // the control: the system writes its number
        Tool.Refuses(3, ["join", "[fe80::1%nope7]:7"], "'fe80::1%nope7' is in the zone 'nope7', and this machine has no network interface of that name or number.");
        Tool.Refuses(2, ["join", "[2001:db8::7%lo]:7"], "does not say where the host is");
    }

    [Theory]
    [InlineData("localhost")]
    [InlineData("[::1]")]
    [InlineData("[::1]:80")]
    [InlineData("")]
    public void ParseLocal_NoAddress_IsRefused(string text) =>
        Tool.Refuses(2, ["host", "--scene", "drop", "--address", text], $"--address is '{text}'", "0.0.0.0 or :: for all");
}
