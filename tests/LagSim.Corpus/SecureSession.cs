using System;
using System.IO;
using System.Net;
using LagSim.Events;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Corpus;

/// <summary>What two runtimes play together in a protected session, and what must come of it.</summary>
internal static class SecureSession
{
    private const string Key = "corpus";
    private const int StatesWanted = 3;

    /// <summary>An emulated processor takes many seconds to compile a handshake.</summary>
    private static readonly SimDuration Silence = SimDuration.FromSeconds(40);

    internal static TimeSpan Patience => TimeSpan.FromSeconds(90);

    internal static Scene Scene => new SceneBuilder("corpus")
        .AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.8)
        .AddBody("ball", new BodySpec(0.5, 1, 0.8), new Vector3D(0, 3, 0))
        .Build();

    internal static PlayerAction Kick => PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 5, 0));

    internal static HostOptions Hosting(HostIdentity identity) => new()
    {
        Protection = new SecureHost(identity),
        ConnectKey = Key,
        Timeout = Silence,
    };

    internal static ClientOptions Joining(HostAddress address) => new()
    {
        Protection = new SecureClient(address.Fingerprint),
        ConnectKey = Key,
        Timeout = Silence,
    };

    internal static IPEndPoint EndPoint(HostAddress address) => new(IPAddress.Parse(address.Host), address.Port);

    /// <summary>Whether enough states agreed since a client's kick: the kicked world, too.</summary>
    internal static bool IsEnough(SessionCounters counters, long agreedBefore) => counters.StatesAgreed >= agreedBefore + StatesWanted;

    /// <summary>Says how a client fared; 0 if enough states agreed, none differed, and its kick counted.</summary>
    internal static int Judge(SessionCounters counters, long agreedBefore, TextWriter output)
    {
        output.WriteLine(
            $"{counters.StatesAgreed} states agreed, {counters.StatesDiffered} differed, {counters.DatagramsForged} datagrams forged");
        return IsEnough(counters, agreedBefore) && counters.StatesDiffered == 0 && counters.EventsAccepted == 1 ? 0 : 1;
    }

    internal static void Watch(Session session, TextWriter output)
    {
        session.HandlerFailed += failure => output.WriteLine(failure);
        session.Ended += () => output.WriteLine($"ended: {session.EndReason}");
    }
}
