using System.IO;
using System.Net;
using System.Threading;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;

namespace LagSim.Corpus;

/// <summary>One end of a protected session over UDP on a thread of its own, to be played with an end on another runtime.</summary>
internal static class SecurePeers
{
    /// <summary>Hosts until a client has come and gone; prints the address to join first.</summary>
    internal static int Host(TextWriter output)
    {
        using HostIdentity identity = HostIdentity.Draw();
        using ManualResetEventSlim gone = new();
        using PeerThread host = PeerThread.Host(SecureSession.Scene, 0, SecureSession.Hosting(identity), IPAddress.Loopback, session =>
        {
            session.ClientGone += _ => gone.Set();
            SecureSession.Watch(session, output);
        });
        output.WriteLine(new HostAddress(IPAddress.Loopback.ToString(), host.LocalAddress.ToEndPoint().Port, identity.Fingerprint));
        output.Flush();
        return gone.Wait(SecureSession.Patience) && host.Session.Counters.DatagramsForged == 0 ? 0 : 1;
    }

    /// <summary>Joins, kicks the ball, and leaves once enough states agreed with the host's.</summary>
    internal static int Join(string text, TextWriter output)
    {
        HostAddress address = HostAddress.Parse(text);
        using ManualResetEventSlim enough = new();
        long agreedBefore = -1; // written and read on the session's thread
        using PeerThread client = PeerThread.Join(SecureSession.EndPoint(address), SecureSession.Joining(address), setUp: session =>
        {
            SecureSession.Watch(session, output);
            session.StateCommitted += _ =>
            {
                if (agreedBefore >= 0 && SecureSession.IsEnough(session.Counters, agreedBefore))
                {
                    enough.Set();
                }
            };
        });
        if (!client.WaitUntilRunning(SecureSession.Patience))
        {
            output.WriteLine($"not in: {client.Session.EndReason}");
            return 1;
        }

        client.Ask(session =>
        {
            agreedBefore = session.Counters.StatesAgreed;
            return session.Do(SecureSession.Kick);
        }).Wait();
        enough.Wait(SecureSession.Patience);
        return SecureSession.Judge(client.Ask(session => session.Counters.Copy()).Result, agreedBefore, output);
    }
}
