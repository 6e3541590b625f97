using System.Runtime.Versioning;
using System.Text.Json;
using LagSim.Testing.Links;

namespace LagSim.Play.Browser;

/// <summary>What there is to turn, for the page to build its controls.</summary>
[SupportedOSPlatform("browser")]
internal static class SetupJson
{
    /// <summary>Writes the range of each number of a set-up, and what it usually is, as <c>numbers</c>.</summary>
    internal static void WriteNumbers(Utf8JsonWriter json)
    {
        PlaySetup usual = new();
        json.WriteStartObject("numbers");
        foreach (SetupNumber number in SetupNumber.All)
        {
            json.WriteStartObject(number.Name);
            json.WriteNumber("least", number.Least);
            json.WriteNumber("most", number.Most);
            json.WriteNumber("usual", number.Get(usual));
            json.WriteEndObject();
        }

        json.WriteEndObject();
    }

    /// <summary>Writes the figures of each link profile, and what it has besides them, as <c>profiles</c>.</summary>
    internal static void WriteProfiles(Utf8JsonWriter json)
    {
        json.WriteStartObject("profiles");
        foreach (LinkProfile profile in LinkProfiles.All)
        {
            ProfileFigures figures = ProfileFigures.Of(profile);
            PlaySetup setup = new() { Link = figures.Shown };
            json.WriteStartObject(profile.Name);
            foreach (SetupNumber number in SetupNumber.All)
            {
                if (number.IsOfLink)
                {
                    json.WriteNumber(number.Name, number.Get(setup));
                }
            }

            json.WriteString("besides", string.Join("; ", figures.Besides));
            json.WriteEndObject();
        }

        json.WriteEndObject();
    }
}
