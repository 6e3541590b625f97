using System;
using System.Collections.Generic;
using System.Globalization;
using System.Runtime.InteropServices.JavaScript;
using System.Runtime.Versioning;
using System.Text;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Play.Browser;

/// <summary>What the page of a host calls: one peer of its session, or two of them where two people share a keyboard.</summary>
/// <remarks>Everything is on the page's one thread. The session is stepped when a datagram arrives, when something is due, and once a frame,
/// so that it goes on in a tab that is hidden, where there are no frames.</remarks>
[SupportedOSPlatform("browser")]
internal static partial class JoinExports
{
    private static readonly TimeSpan LongestWait = TimeSpan.FromSeconds(1);

    private static readonly Dictionary<int, (JoinedWorld World, WebSocketClientPort Port)> Peers = [];
    private static readonly FrameWriter Frame = new();

    private static int joined;

    /// <summary>Joins a host's session, with one more peer of this page.</summary>
    /// <param name="address">Of its WebSocket.</param>
    /// <param name="fingerprint">Of the host; empty if its session is not protected.</param>
    /// <param name="key">That the host asks for; empty for none.</param>
    /// <param name="name">What the others are shown.</param>
    /// <param name="pass">Of the player that this one was before; empty for none.</param>
    /// <param name="timeoutSeconds">How long the host may be silent.</param>
    /// <param name="rejoinSeconds">How long it is asked again when it was.</param>
    /// <returns>A sentence on what cannot be; empty if it asks now. In the other calls it has the next number, from 0.</returns>
    [JSExport]
    internal static string Join(string address, string fingerprint, string key, string name, string pass, double timeoutSeconds, double rejoinSeconds)
    {
        WebSocketClientPort? port = null;
        try
        {
            PlayerPass.TryParse(pass, out PlayerPass former);
            ClientOptions options = new()
            {
                ConnectKey = key,
                Name = name,
                Pass = former,
                Protection = fingerprint.Length == 0 ? null : new SecureClient(Fingerprint(fingerprint)),
                Warmup = false,
                Timeout = SimDuration.FromSeconds(timeoutSeconds),
                RejoinTime = SimDuration.FromSeconds(rejoinSeconds),
            };
            port = new WebSocketClientPort(new Uri(address));
            JoinedWorld world = new(port, WebSocketClientPort.Host, options, new StopwatchClock());
            Peers.Add(joined++, (world, port));
            AirHockeyExports.PlayerOf = peer => Held(peer)?.Player;
            AirHockeyExports.BoardOf = peer => WorldOf(peer).Board!;
            port.Arrived += () => world.Step();
            _ = StepWhenDueAsync(world);
            return "";
        }
        catch (Exception refused) when (refused is FormatException or ArgumentException or InvalidOperationException)
        {
            port?.Dispose(); // it would go on connecting
            string ofCode = refused is ArgumentException { ParamName: string parameter } ? $" (Parameter '{parameter}')" : "";
            string why = ofCode.Length > 0 ? refused.Message.Replace(ofCode, "", StringComparison.Ordinal) : refused.Message;
            return why.ReplaceLineEndings(" ");
        }
    }

    /// <summary>What is drawn of a peer, as JSON: the rectangle of the view, what stands still in it, and the bodies; empty until the scene is there.</summary>
    [JSExport]
    internal static string Describe(int peer) => WorldOf(peer).View is not PlayScene view ? "" : Encoding.UTF8.GetString(JsonBytes.Of(json =>
    {
        json.WriteString("scene", view.IsAirHockey ? AirHockeyGame.Name : view.Scene.Name);
        json.WriteNumber("began", WorldOf(peer).Session.World?.Simulation.Start.Ticks ?? 0); // another session of a host has another time
        json.WriteNumber("peer", WorldOf(peer).Peer); // which can be another in the same session, too
        SceneJson.WriteView(json, view);
        json.WriteStartArray("bodies");
        foreach (JoinedBody body in WorldOf(peer).Bodies)
        {
            json.WriteStartObject();
            json.WriteString("name", body.Body.ToString());
            json.WriteNumber("radius", body.Radius);
            json.WriteEndObject();
        }

        json.WriteEndArray();
    }));

    /// <summary>How a peer's session stands, as JSON.</summary>
    [JSExport]
    internal static string Status(int peer) => Encoding.UTF8.GetString(JsonBytes.Of(json =>
    {
        (JoinedWorld world, WebSocketClientPort port) = Peers[peer];
        ClientSession session = world.Session;
        json.WriteString("state", (world.HasEnded ? SessionState.Ended : session.State).ToString());
        json.WriteString("end", world.EndReason);
        json.WriteString("ended_by", session.EndedBy.ToString());
        json.WriteBoolean("key_wrong", world.IsKeyWrong);
        json.WriteString("connection", port.Failure);
        json.WriteBoolean("connected", port.IsConnected);
        json.WriteNumber("reconnections", port.Reconnections);
        json.WriteNumber("player", session.Peer);
        json.WriteBoolean("looks_on", world.View?.IsAirHockey == true && world.Player is null);
        json.WriteString("pass", session.Pass?.ToString());
        json.WriteNumber("heals", session.Counters.Heals);
        json.WriteNumber("agreed", session.Counters.StatesAgreed);
        json.WriteNumber("differed", session.Counters.StatesDiffered);
        json.WriteNumber("lost", session.Counters.EventsLost);
        json.WriteNumber("superseded", port.Superseded);
        json.WriteNumber("round_trip_ms", session.Links is [LinkTraffic link, ..] ? link.RoundTrip.ToMilliseconds() : 0);
        json.WriteNumber("at", session.Committed is CommittedState last && session.World is LiveWorld live
            ? (last.Time - live.Simulation.Start).ToSeconds() : 0);
        json.WriteString("hash", session.Committed?.StateHash.ToString("x16", CultureInfo.InvariantCulture));
        json.WriteStartArray("here");
        foreach (RosterMember one in session.Roster)
        {
            json.WriteStartObject();
            json.WriteNumber("number", one.Number);
            json.WriteString("name", one.Name);
            json.WriteBoolean("silent", one.SilentSince is not null);
            json.WriteBoolean("plays", one.Number > 0 && one.Role != PeerRole.Spectator);
            json.WriteEndObject();
        }

        json.WriteEndArray();
    }));

    /// <summary>The committed states of a peer since the last call, each as its time in seconds and its two hashes.</summary>
    [JSExport]
    internal static string[] TakeCommits(int peer)
    {
        List<string> taken = [];
        while (WorldOf(peer).TryTakeCommit(out double seconds, out CommittedState state))
        {
            taken.Add(string.Create(CultureInfo.InvariantCulture, $"T {seconds} s state {state.StateHash:x16} events {state.EventHash:x16}"));
        }

        return [.. taken];
    }

    /// <summary>Steps a peer, and gives the page the numbers of its frame.</summary>
    /// <returns>A number that is another one when there are other bodies than before, which <see cref="Describe"/> then has.</returns>
    [JSExport]
    internal static int Advance(int peer, double realSeconds)
    {
        JoinedWorld world = Peers[peer].World;
        world.Step();
        world.Draw(realSeconds);
        IReadOnlyList<JoinedBody> bodies = world.Bodies;
        LinkTraffic? link = world.Session.Links is [LinkTraffic only, ..] ? only : null;
        Frame.Begin(panes: 1, bodies.Count, world.Seconds);
        Frame.WritePane(
            error: 0, world.Session.Counters.Heals, world.EventsRerun, world.BodiesRewound, link?.BytesSent ?? 0, link?.BytesReceived ?? 0, world.IsHolding);
        foreach (JoinedBody body in bodies)
        {
            Frame.WriteBody(new DrawnPlace(true, body.Place, body.Place, body.Glow, body.IsInHand)); // nobody knows here where it is without delay
        }

        Frame.Show();
        return world.BodiesVersion;
    }

    /// <summary>The person at a peer takes a body.</summary>
    [JSExport]
    internal static bool Grab(int peer, double x, double y, double reach) => Held(peer)?.Grab(x, y, reach) == true;

    /// <summary>The hand moves.</summary>
    [JSExport]
    internal static void MoveHand(int peer, double x, double y, double velocityX, double velocityY) =>
        Held(peer)?.MoveHand(x, y, velocityX, velocityY);

    /// <summary>The hand lets go.</summary>
    [JSExport]
    internal static void Release(int peer, double velocityX, double velocityY) => Held(peer)?.Release(velocityX, velocityY);

    /// <summary>All peers of this page leave the session.</summary>
    [JSExport]
    internal static void Leave()
    {
        foreach ((JoinedWorld world, _) in Peers.Values)
        {
            world.Dispose();
        }
    }

    /// <summary>Gives up the world of a peer that has ended, and its connection, which would otherwise be opened again for ever.</summary>
    [JSExport]
    internal static void Drop(int peer)
    {
        WorldOf(peer).Dispose();
        Peers.Remove(peer);
    }

    /// <summary>How many worlds are held, for scripts and tests.</summary>
    [JSExport]
    internal static int CountHeld() => Peers.Count;

    /// <summary>Why a name cannot be, as a sentence; empty if it can.</summary>
    [JSExport]
    internal static string WhyNoName(string name) => JoinedName.WhyNot(name) ?? "";

    /// <summary>Why a key cannot be that of any session, as a sentence; empty if it can.</summary>
    [JSExport]
    internal static string WhyNoKey(string key) => key.Length <= SessionOptions.MaxKeyLength ? ""
        : FormattableString.Invariant($"A key has at most {SessionOptions.MaxKeyLength} characters; this one has {key.Length}.");

    private static JoinedWorld WorldOf(int peer) => Peers[peer].World;

    /// <summary>The world of a peer; null if it was given up: what a hand does that was still on it goes nowhere.</summary>
    private static JoinedWorld? Held(int peer) => Peers.TryGetValue(peer, out (JoinedWorld World, WebSocketClientPort) one) ? one.World : null;

    private static HostFingerprint Fingerprint(string text) =>
        HostFingerprint.TryParse(text, out HostFingerprint read) ? read : throw new FormatException($"'{text}' is no fingerprint of a host.");

    private static async Task StepWhenDueAsync(JoinedWorld world)
    {
        while (!world.HasEnded)
        {
            TimeSpan due = TimeSpan.FromSeconds(Math.Max(0, world.Step().ToSeconds()));
            await Task.Delay(due < LongestWait ? due : LongestWait);
        }

        if (world.Failure is Exception thrown)
        {
            await Console.Error.WriteLineAsync(thrown.ToString()); // the stack, for the browser's console; the page has the sentence
        }
    }
}
