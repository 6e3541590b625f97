using System;
using System.Net;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Scenes;

namespace LagSim.Tests.Docs;

/// <summary>The code of docs/SECURITY.md and of the page of LagSim.Net.Secure, as it stands there.</summary>
internal static class SecuritySnippets
{
    internal static void Protected(Scene scene, string line)
    {
        HostIdentity identity = HostIdentity.Draw(); // or the one you kept
        using PeerThread host = PeerThread.Host(scene, udpPort: 5000, new HostOptions { Protection = new SecureHost(identity) });
        Console.WriteLine(new HostAddress("192.168.0.7", 5000, identity.Fingerprint)); // lagsim://192.168.0.7:5000#...

        // on another machine, given that line
        HostAddress address = HostAddress.Parse(line);
        ClientOptions options = new() { Protection = new SecureClient(address.Fingerprint) };
        using PeerThread client = PeerThread.Join(new IPEndPoint(Dns.GetHostAddresses(address.Host)[0], address.Port), options);
    }

    internal static void ChangedKey(HostAddress address, IPEndPoint there)
    {
        SecureClient protection = new(address.Fingerprint); // the one that was remembered
        using PeerThread client = PeerThread.Join(there, new ClientOptions { Protection = protection }, setUp: session =>
            session.HostKeyChanged += () => Remember(protection.Host!.Value)); // called on the session's thread, when it joins or joins again

        static void Remember(HostFingerprint fingerprint) => GC.KeepAlive(fingerprint);
    }

    internal static void Tokens(TokenIssuer issuer, HostAddress hostAddress, HostIdentity identity, HostAddress address)
    {
        // backend: keeps issuer.ToSecretText(), gives hosts issuer.Key
        byte[] token = issuer.Issue(new PlayerAdmission("account 4711", "Ada", PlayerRights.All), hostAddress.Fingerprint);

        // host
        HostOptions hosting = new() { Protection = new SecureHost(identity, issuer.Key) };

        // client
        ClientOptions joining = new() { Protection = new SecureClient(address.Fingerprint), Token = token };
        GC.KeepAlive((hosting, joining));
    }
}
