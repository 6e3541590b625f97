using System;
using System.CommandLine;
using System.CommandLine.Parsing;
using System.Globalization;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Strategies;
using LagSim.Testing.Links;

namespace LagSim.Cli.Commands;

/// <summary>The options that every command has, and their validation.</summary>
internal sealed class CommonOptions
{
    internal const string SeedName = "--seed";

    internal static readonly string SceneText = $"A built-in scene's name ({BuiltInScenes.KnownNames}), or a JSON file; see 'lagsim scenes'.";

    internal const string JsonName = "--json";

    /// <summary>The strategy that uses a display delay.</summary>
    internal const string Interpolating = "interpolation";

    /// <summary>The most characters of a list of choices in the left column of help. Longer lists go to the description.</summary>
    private const int MaxWordsLength = 30;

    private const string DisplayDelayName = "--display-delay-ms";

    internal Option<ulong> Seed { get; } = new(SeedName)
    {
        Description = "The seed for everything random: links, clocks, cases. The same seed gives the same run.",
        DefaultValueFactory = _ => 1,
        HelpName = "N",
        CustomParser = ParseSeed,
    };

    internal Option<string?> Out { get; } = Folder("--out", "A folder for CSV and SVG files and a report.html that shows them; existing files of the same names are replaced.");

    internal Option<bool> Json { get; } = new(JsonName) { Description = "Print one JSON document and nothing else on stdout." };

    /// <param name="command">The command.</param>
    /// <param name="isSeedDrawnFrom">Whether any result depends on the seed.</param>
    internal void AddTo(Command command, bool isSeedDrawnFrom = true)
    {
        AddSeedAndJsonTo(command, isSeedDrawnFrom);
        command.Options.Add(Out);
    }

    /// <summary>The options of a command that writes no folder.</summary>
    internal void AddSeedAndJsonTo(Command command, bool isSeedDrawnFrom = true)
    {
        Seed.Description = isSeedDrawnFrom ? Seed.Description : "Only repeated in the results: every command takes a seed, but nothing here is random.";
        command.Options.Add(Seed);
        command.Options.Add(Json);
    }

    /// <summary>A number option with a range, which excludes NaN.</summary>
    internal static Option<double> Number(string name, string description, double? byDefault, double least, double most)
    {
        Option<double> option = new(name)
        {
            Description = string.Create(CultureInfo.InvariantCulture, $"{description} ({least} to {most})"),
            HelpName = "NUMBER",
            CustomParser = result => ParseNumber(result, name, least, most),
        };
        if (byDefault is double value)
        {
            option.DefaultValueFactory = _ => value;
        }

        return option;
    }

    /// <summary>An option with a number that may be left out; <paramref name="otherwise"/> says what is so then.</summary>
    internal static Option<double?> NumberOr(string otherwise, string name, string description, double least, double most) => new(name)
    {
        Description = string.Create(CultureInfo.InvariantCulture, $"{description} ({least} to {most}); {otherwise}"),
        HelpName = "NUMBER",
        CustomParser = result => ParseNumber(result, name, least, most),
    };

    /// <summary>How far behind the present <c>interpolation</c> shows the world.</summary>
    internal static Option<double> DisplayDelay() => Number(
        DisplayDelayName, "How far behind shared time the interpolation strategy shows the world", Math.Round(Interpolation.DefaultDelay.ToMilliseconds(), 6), 0, Interpolation.MaxDelay.ToMilliseconds());

    /// <summary>Refuses a display delay that no strategy would use.</summary>
    /// <exception cref="UsageException">The delay is given, and the strategy is neither <c>interpolation</c> nor all.</exception>
    internal static void ThrowIfUnused(ParseResult parsed, Option<double> displayDelay, string strategy, bool isInterpolating)
    {
        if (!isInterpolating && parsed.GetResult(displayDelay) is { Implicit: false })
        {
            throw new UsageException(
                $"{DisplayDelayName} is for the strategy {Interpolating} alone, and --strategy is '{strategy}': it would have no effect.");
        }
    }

    /// <summary>The delay of every client's link.</summary>
    internal static Option<double?> Delay(string otherwise) => new("--delay-ms")
    {
        Description = $"Delay added one way, without jitter or loss (0 to 2000); {otherwise}. Cannot be combined with --profile.",
        HelpName = "NUMBER",
        CustomParser = result => ParseNumber(result, "--delay-ms", 0, LinkProfiles.MaxPureDelay),
    };

    /// <summary>The profile of every client's link.</summary>
    internal static Option<string?> Profile() => new("--profile")
    {
        Description = $"The link between each client and the host: {string.Join(", ", LinkProfiles.All.Select(p => p.Name))},"
            + $" or {LinkProfiles.AnyDelay}.",
        HelpName = "NAME",
    };

    /// <summary>Returns the link chosen by a delay or a profile; null if neither is given.</summary>
    /// <exception cref="UsageException">Both are given, or the profile is unknown.</exception>
    internal static LinkProfile? LinkOf(double? delay, string? profile)
    {
        if (delay is not null && profile is not null)
        {
            throw new UsageException("--delay-ms and --profile exclude each other: a profile has its own delay.");
        }

        return delay is double milliseconds ? LinkProfiles.PureDelay(milliseconds)
            : profile is null ? null
            : LinkProfiles.TryGet(profile, out LinkProfile? found, out string? error) ? found : throw new UsageException(error);
    }

    /// <summary>The choice of real or virtual time.</summary>
    internal static Option<string> Time(string byDefault) =>
        Word("--time", "Real time over real sockets, or the same in virtual time, seeded, without waiting.", byDefault, "real", "virtual");

    private static Option<string?> Folder(string name, string description)
    {
        Option<string?> option = Path(name, description, "FOLDER");
        Refuse(option, System.IO.File.Exists, "that is a file, it must be a folder");
        return option;
    }

    /// <summary>An option that names a file to write.</summary>
    internal static Option<string?> File(string name, string description)
    {
        Option<string?> option = Path(name, description, "FILE");
        Refuse(option, file => file != ResultFile.StandardOutput && System.IO.Directory.Exists(file), "that is a folder, it must be a file");
        return option;
    }

    private static void Refuse(Option<string?> option, Func<string, bool> isWrong, string why) => option.Validators.Add(result =>
    {
        if (result.Tokens.Count == 1 && isWrong(result.Tokens[0].Value))
        {
            result.AddError($"{option.Name} is '{result.Tokens[0].Value}'; {why}.");
        }
    });

    /// <summary>An option that names a file or folder, and refuses an empty name.</summary>
    private static Option<string?> Path(string name, string description, string help)
    {
        Option<string?> option = new(name) { Description = description, HelpName = help };
        option.Validators.Add(result =>
        {
            if (result.Tokens.Count == 1 && (result.Tokens[0].Value.Length == 0 || result.Tokens[0].Value.Contains('\0', StringComparison.Ordinal)))
            {
                result.AddError($"{name} is '{result.Tokens[0].Value.Replace("\0", "\\0", StringComparison.Ordinal)}'; it must be the name of a"
                    + $" {help.ToLowerInvariant()}.");
            }
        });
        return option;
    }

    /// <summary>An option with a choice of words.</summary>
    internal static Option<string> Word(string name, string description, string byDefault, params string[] words)
    {
        bool areFew = words.Sum(word => word.Length + 1) <= MaxWordsLength;
        Option<string> option = new(name)
        {
            Description = areFew ? description : $"{description.TrimEnd('.')}: one of {string.Join(", ", words)}.",
            DefaultValueFactory = _ => byDefault,
            HelpName = areFew ? string.Join('|', words) : "NAME",
        };
        option.CompletionSources.Add(words);
        option.Validators.Add(result =>
        {
            if (result.Tokens.Count == 1 && !words.Contains(result.Tokens[0].Value))
            {
                result.AddError($"{name} is '{result.Tokens[0].Value}'; it must be one of {string.Join(", ", words)}.");
            }
        });
        return option;
    }

    /// <summary>An option for an integer in a range.</summary>
    internal static Option<int> Whole(string name, string description, int byDefault, int least, int most) => new(name)
    {
        Description = $"{description} ({least} to {most})",
        DefaultValueFactory = _ => byDefault,
        HelpName = "N",
        CustomParser = result => ParseWhole(result, name, least, most),
    };

    /// <summary>Parses an option's only argument as a whole number. An error names the option and its range.</summary>
    internal static int ParseWhole(ArgumentResult result, string name, int least, int most)
    {
        if (int.TryParse(Token(result), NumberStyles.AllowLeadingSign, CultureInfo.InvariantCulture, out int value) && value >= least && value <= most)
        {
            return value;
        }

        result.AddError($"{Typed(result, name)} is '{Token(result)}'; it must be a whole number between {least} and {most}.");
        return least;
    }

    /// <summary>Parses an option's only argument as a number. An error names the option and its range.</summary>
    internal static double ParseNumber(ArgumentResult result, string name, double least, double most)
    {
        if (double.TryParse(Token(result), NumberStyles.Float, CultureInfo.InvariantCulture, out double value) && value >= least && value <= most)
        {
            return value;
        }

        result.AddError(FormattableString.Invariant($"{Typed(result, name)} is '{Token(result)}'; it must be a number between {least} and {most}."));
        return double.NaN;
    }

    private static ulong ParseSeed(ArgumentResult result)
    {
        if (ulong.TryParse(Token(result), NumberStyles.None, CultureInfo.InvariantCulture, out ulong seed))
        {
            return seed;
        }

        result.AddError($"--seed is '{Token(result)}'; it must be a whole number between 0 and {ulong.MaxValue}.");
        return 0;
    }

    /// <summary>The option as it was typed, which may be an alias.</summary>
    private static string Typed(ArgumentResult result, string name) => (result.Parent as OptionResult)?.IdentifierToken?.Value ?? name;

    private static string Token(ArgumentResult result) => result.Tokens.Count == 1 ? result.Tokens[0].Value : "";
}
