using System;
using System.IO;
using System.Net;
using LagSim.Events;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Scenes;

namespace LagSim.Corpus;

/// <summary>One end of a protected session over UDP, to be played with an end on another runtime: both say what they committed.</summary>
internal static class SecurePeers
{
    private const string Key = "corpus";
    private const int StatesWanted = 3;

    private static readonly TimeSpan Patience = TimeSpan.FromSeconds(60);

    /// <summary>Hosts until a client has come and gone; prints the address to join first.</summary>
    internal static int Host(TextWriter output)
    {
        using HostIdentity identity = HostIdentity.Draw();
        Scene scene = new SceneBuilder("corpus")
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.8)
            .AddBody("ball", new BodySpec(0.5, 1, 0.8), new Vector3D(0, 3, 0))
            .Build();
        HostOptions options = new() { Protection = new SecureHost(identity), ConnectKey = Key };
        using System.Threading.ManualResetEventSlim gone = new();
        using PeerThread host = PeerThread.Host(scene, 0, options, IPAddress.Loopback, session =>
        {
            session.ClientGone += _ => gone.Set();
            Watch(session, output);
        });
        output.WriteLine(new HostAddress(IPAddress.Loopback.ToString(), host.LocalAddress.ToEndPoint().Port, identity.Fingerprint));
        output.Flush();
        return gone.Wait(Patience) && host.Session.Counters.DatagramsForged == 0 ? 0 : 1;
    }

    /// <summary>Joins, kicks the ball, and leaves once enough states agreed with the host's.</summary>
    internal static int Join(string text, TextWriter output)
    {
        HostAddress address = HostAddress.Parse(text);
        ClientOptions options = new() { Protection = new SecureClient(address.Fingerprint), ConnectKey = Key };
        using System.Threading.ManualResetEventSlim enough = new();
        using PeerThread client = PeerThread.Join(new IPEndPoint(IPAddress.Parse(address.Host), address.Port), options, setUp: session =>
        {
            Watch(session, output);
            session.StateCommitted += _ =>
            {
                if (session.Counters.StatesAgreed >= StatesWanted)
                {
                    enough.Set();
                }
            };
        });
        if (!client.WaitUntilRunning(Patience))
        {
            output.WriteLine($"not in: {client.Session.EndReason}");
            return 1;
        }

        client.Do(PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 5, 0))).AsTask().Wait();
        enough.Wait(Patience);
        SessionCounters counters = client.Ask(session => session.Counters.Copy()).Result;
        output.WriteLine(
            $"{counters.StatesAgreed} states agreed, {counters.StatesDiffered} differed, {counters.DatagramsForged} datagrams forged");
        return counters.StatesAgreed >= StatesWanted && counters.StatesDiffered == 0 && counters.EventsAccepted == 1 ? 0 : 1;
    }

    private static void Watch(Session session, TextWriter output)
    {
        session.HandlerFailed += failure => output.WriteLine(failure);
        session.Ended += () => output.WriteLine($"ended: {session.EndReason}");
    }
}
