using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Net.Strategies;

namespace LagSim.Play;

/// <summary>Reads a link to the page: a set-up of all in it that can be, and what cannot.</summary>
/// <remarks>What cannot be is left out and has its default, so a link of another set-up than it says is never taken silently for it.
/// Not thread-safe.</remarks>
internal sealed class SetupReader
{
    private readonly List<(string Name, string Value)> parts = [];
    private readonly List<WrongPart> wrong = [];

    private SetupReader(string query)
    {
        foreach (string part in query.Split('&', StringSplitOptions.RemoveEmptyEntries))
        {
            int equals = part.IndexOf('=', StringComparison.Ordinal);
            parts.Add(equals < 0 ? (Plain(part), "") : (Plain(part[..equals]), Plain(part[(equals + 1)..])));
        }
    }

    /// <summary>Reads a query without its question mark; percent signs and plus signs as browsers write them.</summary>
    /// <returns>The set-up, and what of the query is not in it.</returns>
    internal static (PlaySetup Setup, IReadOnlyList<WrongPart> Wrong) Read(string query)
    {
        SetupReader reader = new(query);
        reader.LeaveOutWhatIsThereTwice();
        reader.LeaveOutWhatAProfileHas();
        return (reader.MadePossible(reader.Each()), reader.wrong);
    }

    private static string Plain(string text) => Uri.UnescapeDataString(text.Replace('+', ' '));

    private void LeaveOutWhatIsThereTwice()
    {
        foreach (IGrouping<string, string> same in parts.GroupBy(part => part.Name, part => part.Value).Where(same => same.Count() > 1).ToArray())
        {
            LeaveOut($"'{same.Key}' is there {same.Count()} times, as {string.Join(", ", same.Select(value => $"'{value}'"))}; once is allowed.", same.Key);
        }
    }

    private void LeaveOutWhatAProfileHas()
    {
        string profile = parts.Find(part => part.Name == "link").Value ?? LinkSettings.Custom;
        if (profile == LinkSettings.Custom || !LinkSettings.Names.Contains(profile))
        {
            return;
        }

        string[] own = [.. SetupNumber.All.Where(number => number.IsOfLink).Select(number => number.Name)];
        string[] both = [.. parts.Select(part => part.Name).Where(own.Contains)];
        if (both.Length > 0)
        {
            wrong.Add(new WrongPart(
                $"'link={profile}' and {string.Join(", ", both.Select(name => $"'{name}={parts.Find(part => part.Name == name).Value}'"))} disagree:"
                    + $" a profile has its own {string.Join(", ", own)}.",
                $"The profile '{profile}' is shown, as it is."));
            parts.RemoveAll(part => both.Contains(part.Name));
        }
    }

    private PlaySetup Each()
    {
        PlaySetup setup = new();
        foreach ((string name, string value) in parts.ToArray())
        {
            try
            {
                setup = name switch
                {
                    "scene" => setup with { Scene = OneOf(name, value, PlayScene.Names) },
                    "link" => setup with { Link = setup.Link with { Profile = OneOf(name, value, LinkSettings.Names) } },
                    "panes" => setup with { Strategies = Panes(value) },
                    _ => NumberNamed(name).Read(setup, value),
                };
            }
            catch (FormatException refused)
            {
                LeaveOut(refused.Message, name);
            }
        }

        return setup;
    }

    /// <summary>Leaves out what each can be by itself, but not together.</summary>
    private PlaySetup MadePossible(PlaySetup setup)
    {
        LinkSettings link = setup.Link;
        if (Math.Abs(link.AsymmetryMilliseconds) > 2 * link.DelayMilliseconds)
        {
            LeaveOut(
                string.Create(
                    CultureInfo.InvariantCulture,
                    $"'asymmetry' is {link.AsymmetryMilliseconds} ms; with a delay of {link.DelayMilliseconds} ms it can be"
                        + $" {2 * link.DelayMilliseconds} ms at most, either way."),
                "asymmetry");
            setup = setup with { Link = link with { AsymmetryMilliseconds = 0 } };
        }

        if (setup.LocalLagMilliseconds > setup.LookAheadMilliseconds)
        {
            LeaveOut(
                string.Create(
                    CultureInfo.InvariantCulture,
                    $"'lag' is {setup.LocalLagMilliseconds} ms; with a look-ahead of {setup.LookAheadMilliseconds} ms ('ahead') it can be that at most."),
                "lag");
            setup = setup with { LocalLagMilliseconds = 0 };
        }

        return setup;
    }

    private void LeaveOut(string sentence, string name)
    {
        wrong.Add(new WrongPart(sentence, new PlaySetup().ValueOf(name) is string usual ? $"'{name}={usual}' is shown instead." : "It is left out."));
        parts.RemoveAll(part => part.Name == name);
    }

    private static SetupNumber NumberNamed(string name) => SetupNumber.All.FirstOrDefault(number => number.Name == name) ?? throw new FormatException(
        $"'{name}' is no part of a set-up; there are scene, link, panes, {string.Join(", ", SetupNumber.All.Select(number => number.Name))}.");

    private static string OneOf(string name, string value, IReadOnlyList<string> allowed) =>
        allowed.Contains(value) ? value
            : throw new FormatException($"'{name}' is '{value}'; it must be one of {string.Join(", ", allowed)}.");

    private static LateEventStrategy[] Panes(string value)
    {
        string[] names = value.Split(',');
        return names.Length is >= 2 and <= PlaySetup.MaxPanes
            ? [.. names.Select(name => LateEventStrategies.OfName(OneOf("panes", name, PlaySetup.StrategyNames)))]
            : throw new FormatException($"'panes' names {names.Length} strategies; there are 2 to {PlaySetup.MaxPanes} panes.");
    }
}
