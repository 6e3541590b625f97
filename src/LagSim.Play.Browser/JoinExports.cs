using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Runtime.InteropServices.JavaScript;
using System.Runtime.Versioning;
using System.Text;
using System.Text.Json;
using System.Threading.Tasks;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Play.Browser;

/// <summary>What the page of a host calls: one peer of its session.</summary>
/// <remarks>Everything is on the page's one thread. The session is stepped when a datagram arrives, when something is due, and once a frame,
/// so that it goes on in a tab that is hidden, where there are no frames.</remarks>
[SupportedOSPlatform("browser")]
internal static partial class JoinExports
{
    private const int NumbersPerPane = 7; // as a pane of the playground, of which this is the only one
    private const int NumbersPerBody = 7;

    private static readonly TimeSpan LongestWait = TimeSpan.FromSeconds(1);

    private static JoinedWorld? joined;
    private static WebSocketClientPort? port;
    private static double[] numbers = [];

    /// <summary>Joins a host's session.</summary>
    /// <param name="address">Of its WebSocket.</param>
    /// <param name="fingerprint">Of the host; empty if its session is not protected.</param>
    /// <param name="key">That the host asks for; empty for none.</param>
    /// <param name="name">What the others are shown.</param>
    /// <param name="pass">Of the player that this one was before; empty for none.</param>
    /// <returns>A sentence on what cannot be; empty if it asks now.</returns>
    [JSExport]
    internal static string Join(string address, string fingerprint, string key, string name, string pass)
    {
        try
        {
            PlayerPass.TryParse(pass, out PlayerPass former);
            ClientOptions options = new()
            {
                ConnectKey = key,
                Name = name,
                Pass = former,
                Protection = fingerprint.Length == 0 ? null : new SecureClient(Fingerprint(fingerprint)),
                Rules = BuiltInRules.All,
                Warmup = false,
            };
            joined?.Dispose();
            port = new WebSocketClientPort(new Uri(address));
            joined = new JoinedWorld(port, WebSocketClientPort.Host, options, new StopwatchClock());
            port.Arrived += Step;
            _ = StepWhenDueAsync(joined);
            return "";
        }
        catch (Exception refused) when (refused is FormatException or ArgumentException or InvalidOperationException)
        {
            return refused.Message;
        }
    }

    /// <summary>What is drawn, as JSON: the rectangle of the view, what stands still in it, and the bodies; empty until the scene is
    /// there.</summary>
    [JSExport]
    internal static string Describe() => joined?.View is PlayScene view ? Encoding.UTF8.GetString(Json(json =>
    {
        json.WriteString("scene", view.Scene.Name);
        SceneJson.WriteView(json, view);
        json.WriteStartArray("bodies");
        foreach (JoinedBody body in joined.Bodies)
        {
            json.WriteStartObject();
            json.WriteString("name", body.Body.ToString());
            json.WriteNumber("radius", body.Radius);
            json.WriteEndObject();
        }

        json.WriteEndArray();
    })) : "";

    /// <summary>How the session stands, as JSON.</summary>
    [JSExport]
    internal static string Status() => joined is null ? "" : Encoding.UTF8.GetString(Json(json =>
    {
        ClientSession session = joined.Session;
        json.WriteString("state", session.State.ToString());
        json.WriteString("end", session.EndReason);
        json.WriteString("connection", port!.Failure);
        json.WriteNumber("player", session.Peer);
        json.WriteString("pass", session.Pass?.ToString());
        json.WriteNumber("heals", session.Counters.Heals);
        json.WriteNumber("agreed", session.Counters.StatesAgreed);
        json.WriteNumber("differed", session.Counters.StatesDiffered);
        json.WriteNumber("lost", session.Counters.EventsLost);
        json.WriteNumber("superseded", port.Superseded);
        json.WriteNumber("round_trip_ms", session.Links is [LinkTraffic link, ..] ? link.RoundTrip.ToMilliseconds() : 0);
        json.WriteNumber("at", session.Committed is CommittedState last && session.World is LiveWorld world
            ? (last.Time - world.Simulation.Start).ToSeconds() : 0);
        json.WriteString("hash", session.Committed?.StateHash.ToString("x16", CultureInfo.InvariantCulture));
        json.WriteStartArray("here");
        foreach (RosterMember one in session.Roster)
        {
            json.WriteStartObject();
            json.WriteNumber("number", one.Number);
            json.WriteString("name", one.Name);
            json.WriteBoolean("silent", one.SilentSince is not null);
            json.WriteEndObject();
        }

        json.WriteEndArray();
    }));

    /// <summary>The committed states since the last call, each as its time in seconds and its two hashes.</summary>
    [JSExport]
    internal static string[] TakeCommits()
    {
        List<string> taken = [];
        while (joined!.TryTakeCommit(out double seconds, out CommittedState state))
        {
            taken.Add(string.Create(CultureInfo.InvariantCulture, $"T {seconds} s state {state.StateHash:x16} events {state.EventHash:x16}"));
        }

        return [.. taken];
    }

    /// <summary>Steps, and gives the page the numbers of the frame.</summary>
    /// <returns>A number that is another one when there are other bodies than before, which <see cref="Describe"/> then has.</returns>
    [JSExport]
    internal static int Advance(double realSeconds)
    {
        Step();
        joined!.Draw(realSeconds);
        IReadOnlyList<JoinedBody> bodies = joined.Bodies;
        int length = 1 + NumbersPerPane + (bodies.Count * NumbersPerBody);
        if (numbers.Length != length)
        {
            numbers = new double[length];
        }

        int at = 0;
        numbers[at++] = joined.Seconds;
        numbers[at++] = 0; // nobody knows here what the world without delay would be
        numbers[at++] = joined.Session.Counters.Heals;
        numbers[at++] = joined.EventsRerun;
        numbers[at++] = joined.BodiesRewound;
        numbers[at++] = joined.Session.Links is [LinkTraffic link, ..] ? link.BytesSent : 0;
        numbers[at++] = joined.Session.Links is [LinkTraffic from, ..] ? from.BytesReceived : 0;
        numbers[at++] = joined.IsHolding ? 1 : 0;
        foreach (JoinedBody body in bodies)
        {
            numbers[at++] = 1;
            numbers[at++] = body.Place.X;
            numbers[at++] = body.Place.Y;
            numbers[at++] = body.Place.X;
            numbers[at++] = body.Place.Y;
            numbers[at++] = body.Glow;
            numbers[at++] = body.IsInHand ? 1 : 0;
        }

        TakeFrame(numbers);
        return joined.BodiesVersion;
    }

    /// <summary>The person takes a body.</summary>
    [JSExport]
    internal static bool Grab(double x, double y, double reach) => joined!.Grab(x, y, reach);

    /// <summary>The hand moves.</summary>
    [JSExport]
    internal static void MoveHand(double x, double y, double velocityX, double velocityY) => joined!.MoveHand(x, y, velocityX, velocityY);

    /// <summary>The hand lets go.</summary>
    [JSExport]
    internal static void Release(double velocityX, double velocityY) => joined!.Release(velocityX, velocityY);

    /// <summary>Leaves the session.</summary>
    [JSExport]
    internal static void Leave() => joined?.Dispose();

    [JSImport("takeFrame", "page")]
    private static partial void TakeFrame([JSMarshalAs<JSType.MemoryView>] Span<double> frame);

    private static HostFingerprint Fingerprint(string text) =>
        HostFingerprint.TryParse(text, out HostFingerprint read) ? read : throw new FormatException($"'{text}' is no fingerprint of a host.");

    private static void Step() => joined!.Step();

    private static async Task StepWhenDueAsync(JoinedWorld world)
    {
        while (ReferenceEquals(world, joined) && world.Session.State != SessionState.Ended)
        {
            TimeSpan due = TimeSpan.FromSeconds(Math.Max(0, world.Step().ToSeconds()));
            await Task.Delay(due < LongestWait ? due : LongestWait);
        }
    }

    private static byte[] Json(Action<Utf8JsonWriter> write)
    {
        using MemoryStream stream = new();
        using (Utf8JsonWriter json = new(stream))
        {
            json.WriteStartObject();
            write(json);
            json.WriteEndObject();
        }

        return stream.ToArray();
    }
}
