using System;
using System.CommandLine;
using System.IO;
using System.Linq;
using System.Security.Cryptography;
using System.Security.Cryptography.X509Certificates;
using LagSim.Cli.Output;

namespace LagSim.Cli.Commands;

/// <summary>The options of a host that lets browsers in.</summary>
internal sealed class WebOptions
{
    private readonly Option<int?> port = new("--web")
    {
        Description = "Let browsers join, too: serve a page for them on this TCP port (0 picks a free one), at the same --address.",
        HelpName = "PORT",
    };

    private readonly Option<string[]> origins = new("--web-origin")
    {
        Description = "Let pages from there join, too, as https://example.org; by default only the page that this host serves, at its own addresses.",
        HelpName = "ORIGIN",
    };

    private readonly Option<string?> certificate = CommonOptions.File(
        "--web-certificate", "Serve the page over HTTPS with the certificate and private key in this file, PEM or PFX without a password. Without it who is on"
            + " the path can change the page itself.");

    internal WebOptions() => port.Validators.Add(result =>
    {
        if (result.Tokens.Count == 1 && !(int.TryParse(result.Tokens[0].Value, out int number) && number is >= 0 and <= 65535))
        {
            result.AddError($"--web is '{result.Tokens[0].Value}'; it must be a whole number between 0 and 65535.");
        }
    });

    internal void AddTo(Command command)
    {
        command.Options.Add(port);
        command.Options.Add(origins);
        command.Options.Add(certificate);
    }

    /// <summary>Reads them; null if browsers are not let in.</summary>
    /// <exception cref="UsageException">An option is wrong, or says nothing without <c>--web</c>.</exception>
    /// <exception cref="InputException">The certificate cannot be read.</exception>
    internal WebRequest? Read(ParseResult parsed)
    {
        string[] others = parsed.GetValue(origins) ?? [];
        string? file = parsed.GetValue(certificate);
        if (parsed.GetValue(port) is not int number)
        {
            return others.Length == 0 && file is null ? null
                : throw new UsageException($"{(file is null ? "--web-origin" : "--web-certificate")} says nothing without --web PORT.");
        }

        if (others.FirstOrDefault(origin => !IsOrigin(origin)) is string wrong)
        {
            throw new UsageException($"--web-origin is '{wrong}'; it must be a scheme and a host, with a port if it is not the usual one, as https://example.org.");
        }

        return new WebRequest(number, others, file is null ? null : ReadCertificate(file));
    }

    private static bool IsOrigin(string text) =>
        Uri.TryCreate(text, UriKind.Absolute, out Uri? uri) && uri.Scheme is "http" or "https" && uri.GetLeftPart(UriPartial.Authority) == text;

    private static X509Certificate2 ReadCertificate(string file)
    {
        if (!File.Exists(file))
        {
            throw new InputException($"--web-certificate is '{file}'; there is no such file.");
        }

        try
        {
            X509Certificate2 read = X509Certificate2.GetCertContentType(file) == X509ContentType.Pfx
                ? X509CertificateLoader.LoadPkcs12FromFile(file, null)
                : X509Certificate2.CreateFromPemFile(file);
            return read.HasPrivateKey ? read : throw new CryptographicException("it has no private key");
        }
        catch (Exception failure) when (failure is CryptographicException or IOException or UnauthorizedAccessException)
        {
            throw new InputException(
                $"--web-certificate '{file}' cannot be used; it must hold a certificate and its private key, as PEM or as PFX without a password: {Sentence.Of(failure)}", failure);
        }
    }
}

/// <summary>A request to let browsers in.</summary>
/// <param name="Port">The TCP port; 0 for any.</param>
/// <param name="Origins">Where pages may come from besides the host's own.</param>
/// <param name="Certificate">For HTTPS; null for HTTP.</param>
internal sealed record WebRequest(int Port, string[] Origins, X509Certificate2? Certificate);
