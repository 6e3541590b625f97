using System;
using System.Net;
using System.Text;
using System.Threading;
using System.Threading.Tasks;
using LagSim;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace AirHockey;

/// <summary>A person's game over UDP, in a terminal. Where nobody can press keys a bot plays.</summary>
public sealed class LiveGame
{
    private const int FramesPerSecond = 60;
    private const double Pace = 2.2; // of the hand, in m/s
    private const double KeyStep = 0.09; // how far a key takes it, in metres
    private static readonly LatencyCompensationWindow Window = new(SimDuration.FromSeconds(3));

    private readonly PeerThread me;
    private readonly RuleNotices notices;
    private readonly bool hasKeys = !Console.IsInputRedirected;
    private readonly Picture picture = new();
    private Vector3D target; // of the hand
    private StringBuilder? line; // of chat, while it is typed
    private int player;
    private bool isBot;
    private bool isLeaving;
    private double overSince = double.PositiveInfinity;

    private LiveGame(PeerThread me, RuleNotices notices)
    {
        (this.me, this.notices) = (me, notices);
        isBot = !hasKeys;
    }

    public static int Host(int port, int players)
    {
        RuleNotices notices = new();
        Scene scene = Table.Build(players, new AirHockeyRules(), seed: (ulong)DateTime.UtcNow.Ticks);
        HostOptions options = new() { Window = Window, ConfirmsEarly = true, RuleNotices = notices, ExpectedClients = players - 1, Unprotected = true };
        using PeerThread host = PeerThread.Host(scene, port, options);
        Console.WriteLine($"listening on port {host.LocalAddress.ToEndPoint().Port}; waiting for {players - 1}");
        return new LiveGame(host, notices).Play();
    }

    public static int Join(IPEndPoint there)
    {
        RuleNotices notices = new();
        ClientOptions options = new() { Window = Window, RuleNotices = notices, Rules = [new AirHockeyRules()] };
        using PeerThread client = PeerThread.Join(there, options);
        Console.WriteLine($"joining {there}");
        return new LiveGame(client, notices).Play();
    }

    private int Play()
    {
        if (!me.WaitUntilRunning(TimeSpan.FromMinutes(10)))
        {
            Console.Error.WriteLine(me.Session.EndReason ?? "Nobody came.");
            return 3;
        }

        Session session = me.Session;
        player = session.Peer - Table.PeerOf(session.Scene!, 0);
        int players = Table.PlayersOf(session.Scene!);
        if (player < 0 || player >= players)
        {
            Console.Error.WriteLine($"The table is full: {players} play.");
            return 3;
        }

        me.Refused += (_, _) => { }; // a hand that comes too late: the next keyframe makes up for it
        Hand hand = new(player, players, session.Peer);
        Bot bot = new(player, players, seed: Environment.TickCount & 0xFFFF);
        OwnMallet mallet = new(session, Table.MalletOf(player));
        target = hand.At;
        using (Screen screen = new())
        {
            while (me.State == SessionState.Running && !isLeaving)
            {
                Frame(session, screen, hand, bot, mallet);
                Thread.Sleep(1000 / FramesPerSecond);
            }
        }

        Console.WriteLine(picture.ToText(withColours: !Console.IsOutputRedirected));
        Console.WriteLine(mallet);
        Console.WriteLine(session.EndReason ?? "goodbye");
        return 0;
    }

    private void Frame(Session session, Screen screen, Hand hand, Bot bot, OwnMallet mallet)
    {
        ReadKeys();
        SimTime now = session.DisplayTime;
        if (me.Latest() is not RenderSnapshot snapshot || !snapshot.TryReadRules(now, out Match match))
        {
            return;
        }

        double elapsed = (now - snapshot.Start).ToSeconds();
        while (notices.TryRead(out RuleEvent told))
        {
            screen.Take(told, now, elapsed);
        }

        (Vector3D place, double speed) = isBot ? bot.Think(snapshot, now, hand.At) : (target, Pace);
        hand.Move(snapshot, session.SharedTime.Now, place, speed, action => _ = me.Do(action));
        mallet.Update(snapshot, now, hand.At);
        string keys = isBot ? "a bot plays: B takes over" : "arrows move, B bot, T chat";
        string status = line is not null ? $"say: {line}_" : $"you are player {player}   {keys}, R again, Q quit";
        picture.Draw(snapshot, now, match, elapsed, match.Phase == Phase.Over ? Screen.Winner(match) : screen.BannerAt(elapsed), status, mallet.Drawn);
        screen.Show(picture);

        overSince = match.Phase == Phase.Over ? Math.Min(overSince, elapsed) : double.PositiveInfinity;
        isLeaving |= !hasKeys && elapsed - overSince > 3; // nobody would ask for another match
    }

    private void ReadKeys()
    {
        while (hasKeys && Console.KeyAvailable)
        {
            ConsoleKeyInfo key = Console.ReadKey(intercept: true);
            if (line is not null)
            {
                Type(key);
                continue;
            }

            switch (key.Key)
            {
                case ConsoleKey.LeftArrow or ConsoleKey.A:
                    target += new Vector3D(-KeyStep, 0, 0);
                    break;
                case ConsoleKey.RightArrow or ConsoleKey.D:
                    target += new Vector3D(KeyStep, 0, 0);
                    break;
                case ConsoleKey.UpArrow or ConsoleKey.W:
                    target += new Vector3D(0, 0, -KeyStep);
                    break;
                case ConsoleKey.DownArrow or ConsoleKey.S:
                    target += new Vector3D(0, 0, KeyStep);
                    break;
                case ConsoleKey.B:
                    isBot = !isBot;
                    break;
                case ConsoleKey.T:
                    line = new StringBuilder();
                    break;
                case ConsoleKey.R:
                    _ = me.Do(PlayerAction.Command(new GameCommand(AirHockeyRules.Again)));
                    break;
                case ConsoleKey.Q or ConsoleKey.Escape:
                    isLeaving = true;
                    break;
            }
        }

        target = Hand.InReach(player, target);
    }

    private void Type(ConsoleKeyInfo key)
    {
        if (key.Key is ConsoleKey.Enter or ConsoleKey.Escape)
        {
            if (key.Key == ConsoleKey.Enter && line!.Length > 0)
            {
                _ = me.Do(PlayerAction.Command(new GameCommand(AirHockeyRules.Chat, Encoding.UTF8.GetBytes(line.ToString()))));
            }

            line = null;
        }
        else if (key.Key == ConsoleKey.Backspace)
        {
            line!.Length = Math.Max(0, line.Length - 1);
        }
        else if (!char.IsControl(key.KeyChar) && Encoding.UTF8.GetByteCount($"{line}{key.KeyChar}") <= ChatLine.MaxBytes)
        {
            line!.Append(key.KeyChar);
        }
    }
}
