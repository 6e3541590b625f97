using System;
using LagSim.Net.Protection;
using Xunit;

namespace LagSim.Tests.Protection;

public sealed class HostAddressTests
{
    private const string Print = "6f1c8a0b2d3e4f5061728394a5b6c7d8";

    [Theory]
    [InlineData("lagsim://192.168.0.7:5000#" + Print)]
    [InlineData("lagsim://[::1]:1#" + Print)]
    [InlineData("lagsim://[2001:db8::7]:65535#" + Print)]
    [InlineData("lagsim://play.example.org:5000#" + Print)]
    [InlineData("lagsim://localhost:5000#" + Print)]
    [InlineData("lagsim://[fe80::1%eth0]:5000#" + Print)]
    [InlineData("lagsim://[fe80::1%no-such.interface_7]:5000#" + Print)]
    [InlineData("lagsim://[fe80::1%4]:5000#" + Print)]
    public void Parse_OneSpelling_GivesItAgain(string text)
    {
        HostAddress address = HostAddress.Parse(text);
        Assert.Equal(text, address.ToString());
        Assert.Equal(Print, address.Fingerprint.ToString());
        Assert.Equal(address, new HostAddress(address.Host, address.Port, address.Fingerprint));
    }

    [Theory]
    [InlineData("", "does not begin with")]
    [InlineData("192.168.0.7:5000", "does not begin with")]
    [InlineData("LAGSIM://192.168.0.7:5000#" + Print, "does not begin with")]
    [InlineData("lagsim://192.168.0.7:5000", "after '#'")]
    [InlineData("lagsim://192.168.0.7:5000#", "after '#'")]
    [InlineData("lagsim://192.168.0.7:5000#6F1C8A0B2D3E4F5061728394A5B6C7D8", "after '#'")]
    [InlineData("lagsim://192.168.0.7:5000#" + Print + "0", "after '#'")]
    [InlineData("lagsim://192.168.0.7:5000#00000000000000000000000000000000", "after '#'")]
    [InlineData("lagsim://192.168.0.7#" + Print, "the port")]
    [InlineData("lagsim://192.168.0.7:0#" + Print, "the port")]
    [InlineData("lagsim://192.168.0.7:65536#" + Print, "the port")]
    [InlineData("lagsim://192.168.0.7:+5#" + Print, "the port")]
    [InlineData("lagsim://:5000#" + Print, "neither an IP address nor a name")]
    [InlineData("lagsim://a/b:5000#" + Print, "neither an IP address nor a name")]
    [InlineData("lagsim://me@host:5000#" + Print, "neither an IP address nor a name")]
    [InlineData("lagsim://[fe80::1%]:5000#" + Print, "neither an IP address nor a name")]
    [InlineData("lagsim://[fe80::1%a b]:5000#" + Print, "neither an IP address nor a name")]
    [InlineData("lagsim://[2001:db8::7%eth0]:5000#" + Print, "neither an IP address nor a name")]
    [InlineData("lagsim://[FE80::1%eth0]:5000#" + Print, "its one spelling is 'lagsim://[fe80::1%eth0]:5000#")]
    [InlineData("lagsim://Host:5000#" + Print, "neither an IP address nor a name")]
    [InlineData("lagsim://192.168.0.7:05000#" + Print, "its one spelling is 'lagsim://192.168.0.7:5000#")]
    [InlineData("lagsim://192.168.7:5000#" + Print, "its one spelling is 'lagsim://192.168.0.7:5000#")]
    [InlineData("lagsim://[0:0::1]:5000#" + Print, "its one spelling is 'lagsim://[::1]:5000#")]
    [InlineData("lagsim://::1:5000#" + Print, "its one spelling is 'lagsim://[::1]:5000#")]
    public void Parse_AnythingElse_SaysWhatIsWrong(string text, string why)
    {
        Assert.False(HostAddress.TryParse(text, out _));
        FormatException refused = Assert.Throws<FormatException>(() => HostAddress.Parse(text));
        Assert.Contains($"'{text}' is not of the form lagsim://HOST:PORT#FINGERPRINT", refused.Message, StringComparison.Ordinal);
        Assert.Contains(why, refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void New_OutOfRange_IsRefused()
    {
        Assert.True(HostFingerprint.TryParse(Print, out HostFingerprint print));
        Assert.Throws<ArgumentException>(() => new HostAddress("a b", 5000, print));
        Assert.Throws<ArgumentOutOfRangeException>(() => new HostAddress("localhost", 0, print));
        Assert.Throws<ArgumentException>(() => new HostAddress("localhost", 5000, default));
        Assert.False(HostAddress.TryParse(null, out _));
    }

    [Fact]
    public void Identity_KeptAsText_IsTheSameHost()
    {
        using HostIdentity drawn = HostIdentity.Draw();
        Assert.True(HostIdentity.TryParse(drawn.ToSecretText(), out HostIdentity? again));
        Assert.Equal(drawn.Fingerprint, again!.Fingerprint);
        Assert.Equal(drawn.Fingerprint.ToString(), again.ToString());
        Assert.DoesNotContain(drawn.ToSecretText(), again.ToString(), StringComparison.Ordinal);
        again.Dispose();
        Assert.Throws<ObjectDisposedException>(() => again.ToSecretText());
        Assert.Throws<ObjectDisposedException>(() => new SecureHost(again).WriteResetKey(new byte[28], new byte[16]));
        Assert.False(HostIdentity.TryParse(drawn.ToSecretText()[1..], out _));
        Assert.False(HostIdentity.TryParse(drawn.ToSecretText().ToUpperInvariant() + " ", out _));
        Assert.False(HostIdentity.TryParse(null, out _));
        using HostIdentity other = HostIdentity.Draw();
        Assert.NotEqual(drawn.Fingerprint, other.Fingerprint);
    }
}
