using System;
using System.Collections.Generic;
using System.Globalization;
using LagSim.Cli.Output;

namespace LagSim.Cli.Commands;

/// <summary>What <c>--do</c> says of a hand that grabs: <c>/force=N</c>, <c>/power=W</c>.</summary>
internal readonly record struct HandOptions(double MaxForce, double MaxPower)
{
    /// <summary>Parses the options of a grab.</summary>
    /// <param name="options">Each without its slash.</param>
    /// <param name="wrong">The exception for what is wrong.</param>
    /// <exception cref="UsageException">One is none.</exception>
    internal static HandOptions Parse(IEnumerable<string> options, Func<string, UsageException> wrong)
    {
        HandOptions read = default;
        foreach (string option in options)
        {
            string[] both = option.Split('=', 2);
            if (both.Length < 2 || both[0] is not ("force" or "power"))
            {
                throw wrong($"'/{option}' must be one of /force=NEWTONS, /power=WATTS");
            }

            if (!double.TryParse(both[1], NumberStyles.Float, CultureInfo.InvariantCulture, out double value) || value is not (> 0 and <= 1e30))
            {
                throw wrong($"'/{option}' must be a number above 0, up to 1e30");
            }

            read = both[0] == "force" ? read with { MaxForce = value } : read with { MaxPower = value };
        }

        return read;
    }
}
