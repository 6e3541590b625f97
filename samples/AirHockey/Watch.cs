using System;
using System.Diagnostics;
using System.Threading;
using LagSim.Hosting;
using LagSim.Testing;
using LagSim.Testing.Links;
using LagSim.Time;

namespace AirHockey;

/// <summary>A match of bots over a simulated link, drawn in real time as the last player sees it.</summary>
public static class Watch
{
    private const double Seconds = 84;
    private const int FramesPerPicture = 2;

    public static int Play(LinkProfile link, int players)
    {
        Picture picture = new();
        Stopwatch clock = Stopwatch.StartNew();
        double began = double.NaN;
        int frame = 0;
        bool isOver = false;
        BotMatch match;
        using (Screen screen = new())
        {
            match = BotMatch.Play(link, players, seed: Environment.TickCount & 0xFFFF, Seconds, () => new AirHockeyRules(), (me, log) =>
            {
                while (log.Notices.TryRead(out RuleEvent told))
                {
                    screen.Take(told, me.Session.SharedTime.Now, me.Seconds);
                    isOver |= told.Kind == NoticeKind.Confirmed && told.Notice.Code == (int)Told.Won;
                }

                SimTime now = me.Session.DisplayTime;
                if (isOver || frame++ % FramesPerPicture != 0 || me.Session.World?.RenderSnapshots.Latest() is not RenderSnapshot snapshot
                    || !snapshot.TryReadRules(now, out Match state))
                {
                    return; // what is left runs as fast as it can
                }

                string status = $"{players} bots over '{link.Name}', as player {me.Number} sees them";
                picture.Draw(snapshot, now, state, me.Seconds, screen.BannerAt(me.Seconds), status);
                screen.Show(picture);
                began = double.IsNaN(began) ? clock.Elapsed.TotalSeconds - me.Seconds : began;
                double early = me.Seconds - (clock.Elapsed.TotalSeconds - began);
                if (early > 0 && !Console.IsOutputRedirected)
                {
                    Thread.Sleep(TimeSpan.FromSeconds(early));
                }
            });
        }

        Console.WriteLine(picture.ToText(withColours: !Console.IsOutputRedirected));
        foreach (string difference in match.Differences)
        {
            Console.WriteLine(difference);
        }

        return match.Differences.Count == 0 ? 0 : 1;
    }
}
